"""How the mission is brought to states that a plain run does not visit: what is done to it, and where."""

from collections.abc import Callable
from dataclasses import dataclass

from fieldnav.evaluation.faults_injection import broken
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.messages import CameraName, Direction
from fieldnav.simulation.injection_camera import CameraFault
from states.behaviour import Step
from states.names import Event, Follow, Path, Phase, Sidestep
from states.table import LATCHED, PAUSED, RECOVERABLE

BLACKOUT_S = 2.7
"""Longer than a camera's silence is held for."""
SOON_S, LATER_S = 0.7, 1.5


@dataclass(frozen=True, slots=True)
class Cue:
    """Once the mission has been in a state for so long, do this."""

    leaf: Path
    after_s: float
    act: Callable[[Rig], object]


def cues() -> tuple[Cue, ...]:
    """In the order in which they come."""
    forward, backward = Direction.FORWARD, Direction.BACKWARD
    tracking = (forward, Phase.FOLLOW, Follow.TRACKING)
    return (
        Cue(tracking, LATER_S, lambda rig: rig.operating.pause(rig.now_s)),
        Cue(PAUSED, LATER_S, lambda rig: rig.operating.resume(rig.now_s)),
        Cue(tracking, SOON_S, _black_out),
        Cue(RECOVERABLE, LATER_S, lambda rig: rig.operating.resume(rig.now_s)),
        Cue(tracking, SOON_S, lambda rig: broken(rig).reboot()),
        Cue(LATCHED, LATER_S, lambda rig: rig.operating.reset(rig.now_s)),
        Cue((forward, Phase.SIDESTEP, Sidestep.SETTLING), SOON_S, _refuse),
        Cue((backward, Phase.SIDESTEP, Sidestep.SETTLING), SOON_S, _refuse),
    )


def _black_out(rig: Rig) -> None:
    rig.cameras[CameraName.FRONT].break_by(CameraFault.BLACK, rig.now_s, rig.now_s + BLACKOUT_S)


def _refuse(rig: Rig) -> None:
    """No picture of a field shows a lane that is none and a moment later one that is: the event is given."""
    refusal = "the next lane is refused, so that the way back can be tried"
    rig.mission.course.behaviours.lane.switching.refused = refusal
    rig.mission.course.go(rig.now_s, Step(event=Event.LANE_REFUSED, reason=refusal))
