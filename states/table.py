"""The mission's states and transitions, declared once as data."""

from dataclasses import dataclass

from fieldnav.messages import Direction
from states.names import Event, Fault, Follow, Path, Phase, Sidestep, Top, text

IDLE: Path = (Top.IDLE,)
CHECKING: Path = (Top.CHECKING,)
RESUMING: Path = (Top.RESUMING,)
PAUSED: Path = (Top.PAUSED,)
RECOVERABLE: Path = (Top.FAULT, Fault.RECOVERABLE)
LATCHED: Path = (Top.FAULT, Fault.LATCHED)
FINISHED: Path = (Top.FINISHED,)


@dataclass(frozen=True, slots=True)
class Transition:
    """On `event` in `source` or its children go to `target`; None: to where the mission is to go on."""

    source: Path
    event: Event
    target: Path | None


def _lane_leaves(direction: Direction) -> tuple[Path, ...]:
    follow = tuple((direction, Phase.FOLLOW, leaf) for leaf in Follow)
    sidestep = tuple((direction, Phase.SIDESTEP, leaf) for leaf in Sidestep)
    return (*follow, (direction, Phase.EXIT), *sidestep)


def _lane_transitions(direction: Direction) -> tuple[Transition, ...]:
    acquiring, tracking, coasting, leaving, *sidestep = _lane_leaves(direction)
    orienting, sampling, crossing, settling, verifying, returning, entering = sidestep
    next_lane = (direction.opposite, Phase.FOLLOW, Follow.ACQUIRING)
    return (
        Transition(acquiring, Event.ROWS_FOUND, tracking),
        Transition(tracking, Event.ROWS_LOST, coasting),
        Transition(tracking, Event.LANE_ENDED, leaving),
        Transition(coasting, Event.ROWS_FOUND, tracking),
        Transition(coasting, Event.LANE_ENDED, leaving),
        Transition(leaving, Event.ROWS_SEEN_AGAIN, coasting),
        Transition(leaving, Event.LANE_LEFT, orienting),
        Transition(leaving, Event.LAST_LANE_LEFT, FINISHED),
        Transition(orienting, Event.WHEELS_TURNED, sampling),
        Transition(sampling, Event.ROW_SAMPLED, crossing),
        Transition(crossing, Event.ROWS_CROSSED, settling),
        Transition(settling, Event.LANE_REACHED, verifying),
        Transition(settling, Event.LANE_REFUSED, returning),
        Transition(verifying, Event.LANE_OFF_CENTRE, settling),
        Transition(verifying, Event.LANE_REFUSED, returning),
        Transition(verifying, Event.LANE_VERIFIED, entering),
        Transition(returning, Event.OLD_LANE_SEEN, crossing),
        Transition(entering, Event.LANE_CENTRED, next_lane),
        Transition((direction,), Event.PAUSE, PAUSED),
        Transition((direction,), Event.FAIL, RECOVERABLE),
        Transition((direction,), Event.LATCH, LATCHED),
    )


LANE_LEAVES = _lane_leaves(Direction.FORWARD) + _lane_leaves(Direction.BACKWARD)
"""The states in which the wheels may move, and no others."""

LEAVES: tuple[Path, ...] = (IDLE, CHECKING, RESUMING, *LANE_LEAVES, PAUSED, RECOVERABLE, LATCHED, FINISHED)

LEAF_NAMED: dict[str, Path] = {text(leaf): leaf for leaf in LEAVES}
"""By the names that journals and ledgers have."""

TRANSITIONS: tuple[Transition, ...] = (
    Transition(IDLE, Event.START, CHECKING),
    Transition(CHECKING, Event.READY, (Direction.FORWARD, Phase.FOLLOW, Follow.ACQUIRING)),
    Transition(CHECKING, Event.RESUME, RESUMING),
    Transition(CHECKING, Event.FAIL, RECOVERABLE),
    Transition(CHECKING, Event.LATCH, LATCHED),
    Transition(CHECKING, Event.PAUSE, PAUSED),
    Transition(RESUMING, Event.PLACE_FITS, None),
    Transition(RESUMING, Event.FAIL, RECOVERABLE),
    Transition(RESUMING, Event.LATCH, LATCHED),
    Transition(RESUMING, Event.PAUSE, PAUSED),
    *_lane_transitions(Direction.FORWARD),
    *_lane_transitions(Direction.BACKWARD),
    Transition(PAUSED, Event.RESUME, None),
    Transition(PAUSED, Event.FAIL, RECOVERABLE),
    Transition(PAUSED, Event.LATCH, LATCHED),
    Transition(PAUSED, Event.RESET, IDLE),
    Transition(RECOVERABLE, Event.RESUME, None),
    Transition(RECOVERABLE, Event.RESET, IDLE),
    Transition(RECOVERABLE, Event.LATCH, LATCHED),
    Transition(LATCHED, Event.RESET, IDLE),
    Transition(FINISHED, Event.RESET, IDLE),
)
