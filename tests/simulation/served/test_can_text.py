"""The text between a socketcand server and its clients, against python-can's side of it."""

import can
import pytest
from can.interfaces.socketcand import socketcand
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.simulation.served.can_text import FRAME_BYTES, RefusedTextError, frame_text, read_send, split

FRAMES = st.one_of(
    st.builds(
        can.Message,
        arbitration_id=st.integers(0, 0x7FF),
        is_extended_id=st.just(False),
        data=st.binary(max_size=8),
    ),
    st.builds(
        can.Message,
        arbitration_id=st.integers(0, 0x1FFFFFFF),
        is_extended_id=st.just(True),
        data=st.binary(max_size=8),
    ),
)


def said(text: bytes) -> str:
    messages, rest = split(text)
    assert rest == b""
    return messages[0]


@given(FRAMES)
def test_what_a_client_sends_is_read_as_it_was_meant(frame: can.Message) -> None:
    text = socketcand.convert_can_message_to_ascii_message(frame).encode()

    read = read_send(said(text), stamp_s=3.5)

    assert read.equals(frame, timestamp_delta=None, check_channel=False, check_direction=False)
    assert read.timestamp == 3.5


@given(FRAMES)
def test_what_a_client_is_told_is_read_by_it_as_it_was_meant(frame: can.Message) -> None:
    text = frame_text(frame, stamp_s=1_700_000_000.25)

    read = socketcand.convert_ascii_message_to_can_message(text.decode().strip())

    assert read.equals(frame, timestamp_delta=None, check_channel=False, check_direction=False)
    assert read.timestamp == 1_700_000_000.25
    assert len(text) == FRAME_BYTES, "python-can warns of a frame that its reads of 1024 bytes cut in two"


def test_messages_come_in_any_pieces() -> None:
    whole = b"< open can0 >< rawmode > < send 201 1 ff >"

    for cut in range(len(whole)):
        first, rest = split(whole[:cut])
        second, end = split(rest + whole[cut:])

        assert [*first, *second] == ["open can0", "rawmode", "send 201 1 ff"] and end == b""


@pytest.mark.parametrize(
    "text", [b"GET / HTTP/1.1\r\n", b"> <", b"< a < b", b"<>", b"\xff\xfe", b"<" + b"a" * 300, b"\x00"]
)
def test_text_that_cannot_become_a_message_is_refused(text: bytes) -> None:
    with pytest.raises(RefusedTextError):
        split(text)


@pytest.mark.parametrize(
    "message",
    [
        "send 800 0",
        "send 2000000F 0",
        "send FFFFFFFF 0",
        "send 201 2 1",
        "send 201 9 1 2 3 4 5 6 7 8 9",
        "send 201 1 100",
        "send 201 1 -1",
        "send 12345 0",
        "send",
        "",
        "add 0 1 123 0",
        "open can0",
        "send 201 1 \N{ARABIC-INDIC DIGIT ONE}",
    ],
)
def test_a_command_that_is_no_frame_is_refused(message: str) -> None:
    with pytest.raises(RefusedTextError):
        read_send(message, 0.0)


@given(st.binary(max_size=300))
def test_no_text_whatever_does_anything_else_than_be_read_or_refused(text: bytes) -> None:
    try:
        for message in split(text)[0]:
            read_send(message, 0.0)
    except RefusedTextError as refusal:
        assert str(refusal)
