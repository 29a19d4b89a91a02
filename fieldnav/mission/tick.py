"""What happened in one tick of the loop, for those who watch: journal pictures, figures, the live line."""

from dataclasses import dataclass, field
from typing import Protocol

from fieldnav.messages import WheelReport
from fieldnav.mission.gate import Passed
from fieldnav.odometry import Pose
from states.behaviour import Step
from states.machine import Change
from states.names import Path


@dataclass(frozen=True, slots=True)
class Tick:
    """What happened in one tick, for those who watch.

    pose: where the wheels say that the robot is; report: what they said last.
    reason: why the state was changed last; warning: what a person should know from this tick on.
    """

    now_s: float
    state: Path
    change: Change | None
    step: Step
    passed: Passed
    lane: int
    rows: int
    rows_passed: int
    forward_m: float
    sideways_m: float
    pose: Pose = field(default_factory=Pose)
    report: WheelReport = field(default_factory=WheelReport)
    warning: str = ""
    reason: str = ""


class Observer(Protocol):
    """Watches the mission; what it does has no way back into it."""

    def watch(self, tick: Tick) -> None: ...
