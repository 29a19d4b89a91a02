"""What the table of faults means in each state: one small function, by which every pair is judged."""

from enum import Enum

from fieldnav.evaluation.faults_injection import Injection
from fieldnav.faults import FaultKind, Reaction
from states.names import Path
from states.table import (
    CHECKING,
    IDLE,
    LANE_LEAVES,
    LATCHED,
    PAUSED,
    RECOVERABLE,
    RESUMING,
)


class Expected(Enum):
    """How a pair must end; the value is how the documentation says it."""

    GOES_ON = "goes on"
    SLOWER = "goes on slower and says so"
    HELD = "is held while it lasts, then goes on"
    PAUSES = "ends in Paused and says so"
    STOPS = "ends in Fault.Recoverable and says so"
    LATCHES = "ends in Fault.Latched and says so"
    MODULES_STOP = "the modules stop by themselves"
    STANDS = "stands, and stays in its state"
    UNTOUCHED = "goes on, or ends in the declared state and says so"


ON_ITS_WAY = frozenset({IDLE, CHECKING, RESUMING, *LANE_LEAVES})
"""States that lead to driving by themselves, Idle as soon as the mission is started."""
WAITING = frozenset({PAUSED, RECOVERABLE})
"""States that a person ends; what does not show in them must be noticed once they have been ended."""
TARGETS = {Expected.PAUSES: PAUSED, Expected.STOPS: RECOVERABLE, Expected.LATCHES: LATCHED}

MOVING = {
    Reaction.CONTINUE: Expected.GOES_ON,
    Reaction.SLOW: Expected.SLOWER,
    Reaction.HOLD: Expected.STOPS,
    Reaction.PAUSE: Expected.PAUSES,
    Reaction.STOP: Expected.STOPS,
    Reaction.LATCH: Expected.LATCHES,
    Reaction.MODULES_STOP: Expected.MODULES_STOP,
}

WITHOUT_A_MISSION = frozenset(
    {FaultKind.MODULE_REBOOTED, FaultKind.MODULE_MODE, FaultKind.PROGRAM, FaultKind.LOOP_LATE}
)
"""Faults that nothing is left of once a mission has been started."""
TOLD_AT_REST = frozenset({FaultKind.EMERGENCY_STOP, FaultKind.MODULE_FAILED, FaultKind.MODULE_MODE})
"""Faults that the modules tell also at rest: a pause becomes a stop, elsewhere they are written down."""
ONCE = frozenset({FaultKind.WALL_CLOCK, FaultKind.LOOP_LATE, FaultKind.FOREIGN_COMMAND})
"""Faults that are over before a person has done anything about them."""


def expected(leaf: Path, injection: Injection) -> Expected:
    """The declared reaction where the robot drives or is about to, by itself or by a person's word.

    At rest a fault that is over again, or a state that is the end, changes nothing.
    """
    if injection.reaction is Reaction.MODULES_STOP:
        return Expected.MODULES_STOP
    if leaf == IDLE and injection.fault in WITHOUT_A_MISSION:
        return Expected.UNTOUCHED
    if leaf in (CHECKING, RESUMING) and injection.fault is FaultKind.LOOP_LATE:
        return Expected.UNTOUCHED  # the wheels stand: nothing has been driven on what was seen before
    if leaf in ON_ITS_WAY:
        return Expected.HELD if injection.passing else MOVING[injection.reaction]
    if injection.fault in TOLD_AT_REST:
        return MOVING[injection.reaction] if leaf == PAUSED else Expected.STANDS
    return MOVING[injection.reaction] if goes_on_by_hand(leaf, injection) else Expected.STANDS


def goes_on_by_hand(leaf: Path, injection: Injection) -> bool:
    """Whether a person lets the mission go on with the fault, unless it has shown itself by then."""
    over = injection.passing or injection.fault in ONCE or injection.fault in TOLD_AT_REST
    return leaf in WAITING and not over
