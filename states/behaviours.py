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
from states.returning import Returning
from states.sampling import Sampling
from states.settling import Settling
from states.standing import Checking, Standing
from states.table import CHECKING
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
    """Makes the behaviour of each leaf as it is entered; every lane and switch begins with a fresh memory."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self.lane = LaneMemory(number=1)
        self.current: Behaviour = Standing()

    def enter(self, change: Change) -> None:
        """Take up the state that the machine has gone to."""
        if change.event is Event.LANE_CENTRED:
            self.lane = self.lane.after()
        self.current = self._make(change.target)

    def _make(self, leaf: Path) -> Behaviour:
        direction = direction_of(leaf)
        if isinstance(direction, Direction):
            return _IN_LANE[leaf[1:]](self._task, direction, self.lane)
        return Checking(self._task) if leaf == CHECKING else Standing()
