"""When the ledger is written, and what a line of it means to the states."""

from dataclasses import asdict
from math import hypot

from fieldnav.errors import SettingsError
from fieldnav.journal.ledger import Booking, Ledger
from fieldnav.mission.travel import Travel
from fieldnav.settings.one_line import one_line
from fieldnav.settings.problems import shortened
from states.behaviour import Task
from states.behaviours import Behaviours
from states.names import Path, Phase, text
from states.place import Place
from states.table import FINISHED, LANE_LEAVES, LEAF_NAMED

ALONG_M, ASIDE_M = 0.25, 0.04
"""Travel after which the place is written down again: sideways rows lie a few decimetres apart."""


class Bookkeeping:
    """Writes down where the mission stands; without a ledger it keeps no books."""

    def __init__(self, ledger: Ledger | None, task: Task, behaviours: Behaviours, travel: Travel) -> None:
        self._ledger, self._task = ledger, task
        self._behaviours, self._travel = behaviours, travel
        self._booked_m = (0.0, 0.0)
        self.newest: Place | None = None

    def travelled(self, now_s: float, leaf: Path) -> None:
        """Book the place if the robot has come far enough since the last line. Raises OutputError."""
        ahead_m, aside_m = self._booked_m
        along_m, sideways_m = self._travel.forward_m - ahead_m, self._travel.sideways_m - aside_m
        if hypot(along_m / ALONG_M, sideways_m / ASIDE_M) >= 1:
            self.book(now_s, leaf, synced=False)

    def book(self, now_s: float, leaf: Path, synced: bool = True) -> None:
        """Book the place, in a lane or between two, or that all is done. Raises OutputError."""
        if leaf in LANE_LEAVES:
            self.newest = self._place(leaf)
        elif leaf != FINISHED or self.newest is None:
            return
        self._booked_m = (self._travel.forward_m, self._travel.sideways_m)
        if self._ledger is not None:
            self._ledger.book(self._booking(now_s, self.newest, leaf == FINISHED), synced)

    def _place(self, leaf: Path) -> Place:
        lane, switch = self._behaviours.lane, self._behaviours.lane.switch
        return Place(
            leaf=leaf,
            lane=lane.number,
            done=self._behaviours.done,
            rows=lane.rows,
            forward_m=self._travel.forward_m,
            sideways_m=self._travel.sideways_m,
            lane_from_m=lane.first_crop_m,
            lane_length_m=lane.length_m,
            expected_m=lane.expected_m,
            pitches_m=lane.pitches_m,
            sidestep_from_m=switch.started_m if switch and Phase.SIDESTEP in leaf else None,
        )

    def _booking(self, now_s: float, place: Place, finished: bool) -> Booking:
        there = asdict(place) | {"state": text(place.leaf), "done": self._behaviours.done}
        del there["leaf"]
        return Booking(
            stamp_s=now_s, side=self._task.side.value, lanes=self._task.lanes, finished=finished, **there
        )


def place_of(booking: Booking) -> Place:
    """The place that a line of the ledger means. Raises SettingsError for a state that there is not."""
    leaf = LEAF_NAMED.get(booking.state)
    if leaf not in LANE_LEAVES:
        state = shortened(one_line(booking.state))
        raise SettingsError(
            f"state: '{state}' is none of a lane's; allowed is such as {text(LANE_LEAVES[0])}"
        )
    known = booking.model_dump(exclude={"stamp_s", "state", "side", "lanes", "finished"})
    return Place(leaf=leaf, **known)
