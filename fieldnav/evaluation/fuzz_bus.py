"""A virtual bus with three ends, and what the third overhears: is a wheel told to turn?"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count

import can

from drivers.can_log import VIRTUAL, open_bus
from fieldnav.settings.robot import Bus

RPDO1 = range(0x201, 0x205)
"""Read here byte by byte, so that a mistake in the DBC file or in its reader cannot hide another."""
SPEED_BYTES = slice(4, 8)
PER_MILLE = 1000

_channels = count(1)


@dataclass(frozen=True, slots=True)
class Ends:
    """The host's end, the modules' end, and a third that throws frames in and overhears all others."""

    host: can.BusABC
    modules: can.BusABC
    third: can.BusABC


@contextmanager
def three_ends() -> Iterator[Ends]:
    """A virtual bus of its own within this process."""
    settings = Bus(interface=VIRTUAL, channel=f"fuzz-{next(_channels)}")
    ends = Ends(open_bus(settings), open_bus(settings), open_bus(settings))
    try:
        yield ends
    finally:
        for bus in (ends.host, ends.modules, ends.third):
            bus.shutdown()


def speeds_told(third: can.BusABC) -> list[tuple[can.Message, float]]:
    """The drive commands that were sent since the last call, each with its share of the top speed."""
    told = []
    while (frame := third.recv(timeout=0)) is not None:
        if frame.arbitration_id in RPDO1 and not frame.is_extended_id:
            per_mille = int.from_bytes(frame.data[SPEED_BYTES], "little", signed=True)
            told.append((frame, per_mille / PER_MILLE))
    return told
