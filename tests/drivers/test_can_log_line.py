"""Whatever the bus is called and whatever frame passes, the line of can.log can be read."""

import io
import shutil
import subprocess
from pathlib import Path

import can
import pytest
from cantools.logreader import Parser
from hypothesis import given
from hypothesis import strategies as st

from drivers.can_log import LoggedBus, open_virtual_pair
from drivers.can_log_line import log_line, shown_channel

STAMP_S = 12.5
DATA = st.binary(max_size=8)
FRAMES = st.one_of(
    st.builds(can.Message, arbitration_id=st.integers(0, 0x7FF), is_extended_id=st.just(False), data=DATA),
    st.builds(can.Message, arbitration_id=st.integers(0, 0x1FFFFFFF), data=DATA),
    st.builds(
        can.Message,
        arbitration_id=st.integers(0, 0x7FF),
        is_extended_id=st.just(False),
        is_remote_frame=st.just(True),
        dlc=st.integers(0, 8),
    ),
    st.builds(
        can.Message,
        arbitration_id=st.integers(0, 0x7FF),
        is_extended_id=st.just(False),
        is_fd=st.just(True),
        bitrate_switch=st.booleans(),
        error_state_indicator=st.booleans(),
        data=st.sampled_from([0, 8, 12, 64]).map(bytes),
    ),
)
ERRORS = st.builds(
    can.Message, arbitration_id=st.integers(0, 0x3FF), is_error_frame=st.just(True), data=st.just(bytes(8))
)
NAMES = st.text(max_size=30)


def read_by_python_can(line: str) -> list[can.Message]:
    return list(can.CanutilsLogReader(io.StringIO(line)))


@given(FRAMES, NAMES, st.booleans())
def test_python_can_reads_every_frame_of_every_bus_as_it_passed(
    frame: can.Message, name: str, received: bool
) -> None:
    frame.is_rx = received

    (read,) = read_by_python_can(log_line(frame, STAMP_S, shown_channel(name)))

    assert read.timestamp == STAMP_S
    assert read.channel == shown_channel(name)
    assert read.equals(frame, timestamp_delta=None, check_channel=False)


@given(FRAMES, NAMES)
def test_cantools_takes_every_frame_of_every_bus_for_a_frame(frame: can.Message, name: str) -> None:
    line = log_line(frame, STAMP_S, shown_channel(name))

    (read,) = Parser(io.StringIO(line))

    assert read.frame_id == frame.arbitration_id
    assert read.is_remote_frame == frame.is_remote_frame


@given(ERRORS, NAMES, st.booleans())
def test_an_error_frame_keeps_its_class_and_its_direction(
    frame: can.Message, name: str, received: bool
) -> None:
    frame.is_rx = received
    line = log_line(frame, STAMP_S, shown_channel(name))

    assert line.split()[2] == f"{0x20000000 | frame.arbitration_id:08X}#0000000000000000"
    assert line.endswith(" R\n" if received else " T\n")
    assert len(read_by_python_can(line)) == 1
    assert list(Parser(io.StringIO(line))) == []


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("can0", "can0"),
        ("can 0", "can_0"),
        ("/dev/serial/by-id/usb-Maker Of Adapters-if00", "/dev/serial/by-id/usb-Maker_Of_Adapters-if00"),
        ("two\nlines\x1b[31m", "two_lines_[31m"),
        ("Anschluß", "Anschlu_"),
        ("can\u20280", "can_0"),
        ("0", "can0"),
        ("", "_"),
    ],
)
def test_a_channel_is_one_word_of_printable_ascii(name: str, shown: str) -> None:
    assert shown_channel(name) == shown


def test_a_bus_with_a_blank_in_its_name_has_a_log_that_can_be_read(tmp_path: Path) -> None:
    host, far = open_virtual_pair()
    logged = LoggedBus(host, tmp_path / "can.log", "my adapter")
    far.send(can.Message(timestamp=1.0, arbitration_id=0x40, is_error_frame=True, data=bytes(8)))
    far.send(can.Message(timestamp=1.1, arbitration_id=0x701, is_extended_id=False, data=[5]))
    while logged.recv(0) is not None:
        pass
    logged.shutdown()
    far.shutdown()

    lines = (tmp_path / "can.log").read_text().splitlines()
    assert lines == ["(1.000000) my_adapter 20000040#0000000000000000 R", "(1.100000) my_adapter 701#05 R"]
    assert len(list(can.LogReader(tmp_path / "can.log"))) == len(lines)


@pytest.mark.skipif(shutil.which("log2asc") is None, reason="can-utils is not installed")
def test_can_utils_reads_the_log(tmp_path: Path) -> None:
    frames = (
        can.Message(arbitration_id=0x701, is_extended_id=False, data=[5]),
        can.Message(arbitration_id=0x20, is_error_frame=True, data=bytes(8)),
        can.Message(arbitration_id=0x701, is_extended_id=False, is_remote_frame=True, dlc=1),
    )
    channel = shown_channel("my adapter")
    (tmp_path / "can.log").write_text("".join(log_line(frame, STAMP_S, channel) for frame in frames))

    done = subprocess.run(
        ["log2asc", "-I", tmp_path / "can.log", channel], capture_output=True, text=True, check=True
    )

    said = done.stdout.splitlines()[-len(frames) :]
    assert "701" in said[0]
    assert "ErrorFrame" in said[1]
    assert "r 1" in said[2]


def test_stamps_of_a_run_on_the_wall_clock_rise_though_a_command_was_made_earlier_in_the_round(
    tmp_path: Path,
) -> None:
    host, far = open_virtual_pair()
    now_s = iter((1.005, 1.074))
    logged = LoggedBus(host, tmp_path / "can.log", "can0", clock=lambda: next(now_s))
    far.send(can.Message(timestamp=0.9, arbitration_id=0x181, is_extended_id=False))
    logged.recv(0)
    command = can.Message(timestamp=1.0, arbitration_id=0x201, is_extended_id=False)

    logged.send(command)

    logged.shutdown()
    far.shutdown()
    assert (tmp_path / "can.log").read_text().splitlines() == [
        "(1.005000) can0 181# R",
        "(1.074000) can0 201# T",
    ]
    assert command.timestamp == 1.0, "the recording goes by the time of the round"
