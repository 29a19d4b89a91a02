"""CAN frames that no good bus carries: random ones, and good telegrams changed, drawn from a seed."""

from collections.abc import Iterable, Sequence
from random import Random

import can

STANDARD_IDS, EXTENDED_IDS = 1 << 11, 1 << 29
EXTENDED_DIGITS, STANDARD_DIGITS = 8, 3
MOST_BYTES = 8
BITS_PER_BYTE = 8
MOST_FLIPPED = 8
"""Bits of one telegram that are flipped; our choice."""
NODE_BITS = 0xF
"""Of an identifier: the part of it that tells the wheel module."""
TOLD_APART_BY = (0, 1, 2, 3)
"""Bytes that hold commands, sequence numbers, SDO indices and the multiplexer of TPDO4."""
ODD_BYTES = (0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF)
ODD_SHARE = 0.3
"""Share of the bytes drawn that are at the edge of what a signal can hold; our choice."""


class FrameFuzz:
    """Draws one frame after another from `random`, starting from the good ones.

    Data frames of the standard ids that are left out are never drawn.
    """

    def __init__(self, random: Random, good: Sequence[can.Message], left_out: Iterable[int] = ()) -> None:
        self._random, self._good = random, good
        self._left_out = frozenset(left_out)
        self._known = sorted({frame.arbitration_id for frame in good})
        self._ways = (
            self._any_id,
            self._known_id,
            self._again,
            self._flipped,
            self._cut,
            self._moved,
            self._commanded,
            self._disguised,
        )

    def draw(self, stamp_s: float) -> can.Message:
        """The next frame, stamped."""
        while True:
            frame = self._random.choice(self._ways)()
            if frame.arbitration_id not in self._left_out or not _is_data(frame):
                frame.timestamp = stamp_s
                return frame

    def _any_id(self) -> can.Message:
        extended = self._tossed()
        number = self._random.randrange(EXTENDED_IDS if extended else STANDARD_IDS)
        return can.Message(arbitration_id=number, is_extended_id=extended, data=self._bytes())

    def _known_id(self) -> can.Message:
        return _standard(self._random.choice(self._known), self._bytes())

    def _again(self) -> can.Message:
        """A good telegram at the wrong time."""
        good = self._random.choice(self._good)
        return _standard(good.arbitration_id, bytes(good.data))

    def _flipped(self) -> can.Message:
        frame = self._again()
        for _ in range(self._random.randint(1, MOST_FLIPPED)):
            bit = self._random.randrange(BITS_PER_BYTE * len(frame.data))
            frame.data[bit // BITS_PER_BYTE] ^= 1 << bit % BITS_PER_BYTE
        return frame

    def _cut(self) -> can.Message:
        """A good telegram that is too short or too long."""
        good = self._again()
        length = self._random.randint(0, MOST_BYTES)
        return _standard(good.arbitration_id, (bytes(good.data) + self._bytes())[:length])

    def _moved(self) -> can.Message:
        """A good telegram in the name of another node, or of another kind from the same node."""
        good, other = self._again(), self._random.choice(self._known)
        node, kind = (good.arbitration_id, other) if self._tossed() else (other, good.arbitration_id)
        return _standard(node & NODE_BITS | kind & ~NODE_BITS, bytes(good.data))

    def _commanded(self) -> can.Message:
        """A good telegram whose command byte, index or multiplexer is none of the protocol's."""
        frame = self._again()
        place = self._random.choice(TOLD_APART_BY)
        if place < len(frame.data):
            frame.data[place] = self._byte()
        return frame

    def _disguised(self) -> can.Message:
        """A good telegram as an extended, a remote or an error frame."""
        good = self._again()
        remote, error = self._random.choice(((False, False), (True, False), (False, True)))
        return can.Message(
            arbitration_id=good.arbitration_id,
            is_extended_id=not (remote or error),
            is_remote_frame=remote,
            is_error_frame=error,
            dlc=len(good.data),
            data=None if remote else good.data,
        )

    def _tossed(self) -> bool:
        return bool(self._random.getrandbits(1))

    def _bytes(self) -> bytes:
        return bytes(self._byte() for _ in range(self._random.randint(0, MOST_BYTES)))

    def _byte(self) -> int:
        odd = self._random.random() < ODD_SHARE
        return self._random.choice(ODD_BYTES) if odd else self._random.randrange(1 << BITS_PER_BYTE)


def _standard(identifier: int, data: bytes) -> can.Message:
    return can.Message(arbitration_id=identifier, is_extended_id=False, data=data)


def _is_data(frame: can.Message) -> bool:
    return not (frame.is_extended_id or frame.is_remote_frame or frame.is_error_frame)


def written(frame: can.Message) -> str:
    """A frame as candump writes it, so that cansend takes it: 201#0100000000000000."""
    digits = EXTENDED_DIGITS if frame.is_extended_id else STANDARD_DIGITS
    kind = "R" if frame.is_remote_frame else bytes(frame.data).hex().upper()
    return f"{frame.arbitration_id:0{digits}X}#{kind}{' (error frame)' if frame.is_error_frame else ''}"
