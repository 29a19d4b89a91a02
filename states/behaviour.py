"""What a state's behaviour gets and gives, and what it may know."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Protocol

from fieldnav.messages import CameraName, Centres, Evidence, Frame, Motion, RowLine, Side
from fieldnav.odometry import Pose
from fieldnav.perception.tracking import Feature
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from states.names import Event


@dataclass(frozen=True, slots=True)
class Observation:
    """What is known at one tick.

    frames: those that are new since the last tick, of the cameras the behaviour asked for.
    forward_m, sideways_m: what the wheels have travelled since the run began, signed in the robot's axes;
    used to bound a manoeuvre and to judge over distance.
    pose: where the wheels say that the robot is, by dead reckoning since the run began; exposed: where it was
    when each of the frames was taken. They carry what was seen along for a few metres, no further.
    """

    now_s: float
    frames: Mapping[CameraName, Frame]
    forward_m: float
    sideways_m: float
    stopped: bool
    wheels_aligned: bool
    wheels_ready: bool
    pose: Pose = field(default_factory=Pose)
    exposed: Mapping[CameraName, Pose] = field(default_factory=dict)

    def exposed_at(self, frame: Frame) -> Pose:
        """Where the robot was when one of the frames was taken."""
        return self.exposed.get(frame.camera, self.pose)


@dataclass(frozen=True, slots=True)
class Sight:
    """What was seen in a frame, for the overlay and the journal."""

    frame: Frame
    rows: tuple[RowLine, ...] = ()
    centres: Centres | None = None
    feature: Feature | None = None


@dataclass(frozen=True, slots=True)
class Step:
    """What a behaviour wants: a motion, at most one event, and everything it judged."""

    motion: Motion = field(default_factory=Motion)
    event: Event | None = None
    evidence: tuple[Evidence, ...] = ()
    sight: Sight | None = None
    reason: str = ""

    def continued(self, motion: Motion | None = None) -> "Step":
        """The same at a tick without a new frame, with the same motion unless another is given."""
        return replace(self, motion=motion or self.motion, event=None, evidence=(), sight=None)

    def with_motion(self, motion: Motion) -> "Step":
        """The same with another motion."""
        return replace(self, motion=motion)


@dataclass(frozen=True, slots=True)
class Task:
    """What the mission is about; the same from start to end."""

    crop: CropProfile
    cameras: Mapping[CameraName, Pinhole]
    side: Side
    lanes: int

    def outward(self, camera: CameraName) -> int:
        """+1 when the side of the next lane is the left of this camera's view, -1 when it is the right."""
        return self.side.sign * (1 if camera is CameraName.FRONT else -1)


class Behaviour(Protocol):
    """One leaf state at work; made anew whenever the state is entered."""

    @property
    def cameras(self) -> tuple[CameraName, ...]:
        """The cameras whose frames are needed; nothing is decided on older ones."""
        ...

    def step(self, seen: Observation) -> Step: ...
