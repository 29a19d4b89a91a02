"""Where a mission stands in its field, as the ledger keeps it; and from where it is taken up again."""

from dataclasses import dataclass
from enum import Enum
from math import copysign

from fieldnav.messages import Direction
from states.memory import LaneMemory
from states.names import Follow, Path, Phase, Sidestep, direction_of

RUN_ON_M = 0.05
"""Sideways at 0.15 m/s: half of what lies between two bookings, the modules' watchdog, and the ramp."""
ONWARD: dict[Enum, int] = {Sidestep.CROSSING: 1, Sidestep.RETURNING: -1}
"""Where a robot that was stopped ran on to: away from the old lane or back to it."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a mission was when this was written down, always in a lane or between two.

    lane: counted from 1; done: the lanes that were left behind; rows: C, seen under the robot; forward_m,
    sideways_m: what the wheels had travelled, signed in the robot's axes; lane_from_m: the driven distance at
    which the lane's first crop was judged, lane_length_m: how far its last is from there, expected_m: the
    length of the lanes before, each None where not known; sidestep_from_m: sideways_m where the sidestep
    began, None outside one.
    """

    leaf: Path
    lane: int
    done: tuple[int, ...]
    rows: int
    forward_m: float
    sideways_m: float
    lane_from_m: float | None = None
    lane_length_m: float | None = None
    expected_m: float | None = None
    pitches_m: tuple[float, ...] = ()
    sidestep_from_m: float | None = None

    @property
    def direction(self) -> Direction:
        direction = direction_of(self.leaf)
        assert direction, "a mission is in a lane or between two when its place is written down"
        return direction


@dataclass(frozen=True, slots=True)
class Resumption:
    """The state in which to go on, in which direction, and what is known of the lane there."""

    leaf: Path
    direction: Direction
    lane: LaneMemory
    moved_m: float = 0.0
    """Sideways since the sidestep began, towards the robot's left."""


def resumption(place: Place) -> Resumption:
    """Where to go on from a place.

    In a lane its rows are found anew. A robot that has left it but not yet moved sideways exits once more.
    From a sidestep it goes back to the old lane and looks for the next from there; one that already drives
    into the next lane is in it.
    """
    lane = LaneMemory(
        place.lane, expected_m=place.expected_m, from_m=place.lane_from_m, pitches_m=place.pitches_m
    )
    direction, _, *leaf = place.leaf
    at = leaf[0] if leaf else Phase.EXIT
    if isinstance(at, Follow):
        return Resumption((direction, Phase.FOLLOW, Follow.ACQUIRING), place.direction, lane)
    if at is Phase.EXIT:
        return Resumption((direction, Phase.EXIT), place.direction, lane)
    if at is Sidestep.ENTERING:
        onward = place.direction.opposite
        entered = LaneMemory(place.lane + 1, expected_m=place.lane_length_m, pitches_m=place.pitches_m)
        return Resumption((onward, Phase.FOLLOW, Follow.ACQUIRING), onward, entered)
    return Resumption((direction, Phase.SIDESTEP, Sidestep.RETURNING), place.direction, lane, _moved_m(place))


def _moved_m(place: Place) -> float:
    """How far the robot stands beside the old lane: as far as was written down, and what it then ran on."""
    if place.sidestep_from_m is None:  # wheels that still turn across
        return 0.0
    moved_m = place.sideways_m - place.sidestep_from_m
    onward = ONWARD.get(place.leaf[-1], 0)
    return moved_m + onward * copysign(RUN_ON_M, moved_m)
