"""Which behaviour belongs to which leaf, and the memories they share."""

from collections.abc import Callable

from fieldnav.messages import Direction
from states.acquiring import Acquiring
from states.behaviour import Behaviour, Task
from states.coasting import Coasting
from states.crossing import CrossingRows
from states.entering import Entering
from states.exiting import Exiting
from states.machine import Change
from states.memory import LaneMemory
from states.names import Event, Follow, Path, Phase, Sidestep, direction_of
from states.orienting import Orienting
from states.place import Place, Resumption, resumption
from states.resuming import ResumingLane
from states.resuming_sidestep import ResumingSidestep
from states.returning import Returning
from states.sampling import Sampling
from states.settling import Settling
from states.standing import Checking, Standing
from states.table import CHECKING, RESUMING
from states.tracking import Tracking
from states.verifying import Verifying

_IN_LANE: dict[Path, Callable[[Task, Direction, LaneMemory], Behaviour]] = {
    (Phase.FOLLOW, Follow.ACQUIRING): Acquiring,
    (Phase.FOLLOW, Follow.TRACKING): Tracking,
    (Phase.FOLLOW, Follow.COASTING): Coasting,
    (Phase.EXIT,): Exiting,
    (Phase.SIDESTEP, Sidestep.ORIENTING): Orienting,
    (Phase.SIDESTEP, Sidestep.SAMPLING): Sampling,
    (Phase.SIDESTEP, Sidestep.CROSSING): CrossingRows,
    (Phase.SIDESTEP, Sidestep.SETTLING): Settling,
    (Phase.SIDESTEP, Sidestep.VERIFYING): Verifying,
    (Phase.SIDESTEP, Sidestep.RETURNING): Returning,
    (Phase.SIDESTEP, Sidestep.ENTERING): Entering,
}


class Behaviours:
    """Makes the behaviour of each leaf as it is entered; every lane and switch begins with a fresh memory.

    `done`: the lanes that were left behind.
    """

    def __init__(self, task: Task) -> None:
        self._task = task
        self.lane = LaneMemory(number=1)
        self.done: tuple[int, ...] = ()
        self.current: Behaviour = Standing()
        self._resumption: Resumption | None = None

    def resume(self, place: Place) -> None:
        """Take over a place from the ledger: once the checks are passed, go on from there."""
        self._resumption = resumption(place)
        self.lane, self.done = self._resumption.lane, place.done

    def enter(self, change: Change) -> None:
        """Take up the state that the machine has gone to."""
        if change.event in (Event.LANE_LEFT, Event.LAST_LANE_LEFT):
            self.done = tuple(sorted({*self.done, self.lane.number}))
        elif change.event is Event.LANE_CENTRED:
            self.lane = self.lane.after()
        elif change.event is Event.PLACE_FITS:
            self._resumption = None
        self.current = self._make(change.target)

    def _make(self, leaf: Path) -> Behaviour:
        direction = direction_of(leaf)
        if isinstance(direction, Direction):
            return _IN_LANE[leaf[1:]](self._task, direction, self.lane)
        if leaf == CHECKING:
            return Checking(self._task, Event.RESUME if self._resumption else Event.READY)
        return self._resuming(self._resumption) if leaf == RESUMING and self._resumption else Standing()

    def _resuming(self, known: Resumption) -> Behaviour:
        between = Sidestep.RETURNING in known.leaf
        return (ResumingSidestep if between else ResumingLane)(self._task, known, self.lane)
