"""The text that socketcand and its clients exchange: `< send 201 8 1 0 0 0 0 0 0 0 >`.

The protocol is that of linux-can's socketcand in raw mode, as python-can's interface of that name speaks it.
"""

import re

import can

from fieldnav.errors import FieldnavError

HELLO, OK = b"< hi >", b"< ok >"
LONGEST = 200
"""Characters of one message; a frame with eight bytes takes 46."""
FRAME_BYTES = 64
"""Each frame's text is filled up to this: python-can reads 1024 bytes at once, and warns of half a frame."""
STANDARD_DIGITS, EXTENDED_DIGITS = 3, 8
LAST_STANDARD, LAST_EXTENDED = 0x7FF, 0x1FFFFFFF

_MESSAGE = re.compile(rb"\s*<([^<>]{1,%d})>" % LONGEST)
_BEGINNING = re.compile(rb"\s*(<[^<>]{0,%d})?" % LONGEST)
_SEND = re.compile(r"send ([0-9A-F]{1,3}|[0-9A-F]{8}) ([0-8])((?: [0-9A-F]{1,2}){0,8})", re.IGNORECASE)


class RefusedTextError(FieldnavError):
    """A client says what the protocol, or this part of it, does not have."""


def split(received: bytes) -> tuple[list[str], bytes]:
    """The whole messages, their words one space apart, and the beginning of one that is still to come.

    Raises RefusedTextError for what cannot become a message.
    """
    messages, at = [], 0
    while (found := _MESSAGE.match(received, at)) is not None:
        messages.append(" ".join(found[1].decode("ascii", "replace").split()))
        at = found.end()
    rest = received[at:]
    if _BEGINNING.fullmatch(rest) is None:
        raise RefusedTextError("this is no message of socketcand")
    return messages, rest.lstrip()


def read_send(message: str, stamp_s: float) -> can.Message:
    """The frame that a client sends. Raises RefusedTextError."""
    found = _SEND.fullmatch(message)
    if found is None:
        raise RefusedTextError("unknown command")
    identifier, extended = int(found[1], 16), len(found[1]) > STANDARD_DIGITS
    data = bytes(int(byte, 16) for byte in found[3].split())
    if len(data) != int(found[2]) or identifier > (LAST_EXTENDED if extended else LAST_STANDARD):
        raise RefusedTextError("this is no CAN frame")
    return can.Message(timestamp=stamp_s, arbitration_id=identifier, is_extended_id=extended, data=data)


def frame_text(frame: can.Message, stamp_s: float) -> bytes:
    """What a client is told of a data frame; the stamp is in seconds since 1970, as socketcand has it."""
    digits = EXTENDED_DIGITS if frame.is_extended_id else STANDARD_DIGITS
    identifier = f"{frame.arbitration_id:0{digits}X}"
    text = f"< frame {identifier} {stamp_s:.6f} {bytes(frame.data).hex().upper()} >"
    return text.rjust(FRAME_BYTES).encode()


def error_text(reason: str) -> bytes:
    """What a client is told before it is left."""
    return f"< error {reason} >".encode()
