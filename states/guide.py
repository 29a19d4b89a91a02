"""What keeps the robot on its lane: the two control laws behind one small interface."""

from dataclasses import dataclass
from typing import Protocol

from fieldnav.messages import CameraName, Centres, Evidence, Frame, Motion, RowLine
from fieldnav.odometry import Pose
from fieldnav.perception.lane import LaneFit
from fieldnav.perception.tracking import Feature
from states.names import Event


@dataclass(frozen=True, slots=True)
class Look:
    """What a frame showed of the lane: its rows, left to right, and in how many of them enough plants stood.

    rows: none where this camera has not found them yet.
    """

    rows: tuple[RowLine, ...]
    rows_seen: int


class Guide(Protocol):
    """Follows one lane from its first look to its exit. Poses are those of the robot's dead reckoning."""

    def begin(self, fit: LaneFit, frame: Frame, pose: Pose) -> None:
        """The lane has been found, or found again, in a frame of either camera taken at a pose."""
        ...

    def look(self, frame: Frame, centres: Centres, pose: Pose) -> Look:
        """Take in a frame of either camera, taken at a pose."""
        ...

    def rows(self, camera: CameraName, pose: Pose) -> tuple[RowLine, ...]:
        """Where the rows must run in a camera's picture, left to right, with nothing new seen."""
        ...

    def motion(self, pose: Pose, speed_mps: float, camera: CameraName) -> Motion:
        """What to do now at a speed > 0 along the lane, led by a camera."""
        ...

    @property
    def feature(self) -> Feature | None:
        """The middle of the lane in the image of the last look; None where nothing is known of it."""
        ...

    def evidence(self, pose: Pose, lost: Event | None = None) -> tuple[Evidence, ...]:
        """What the motion was made from; `lost`: the event that comes about when it can guide no further."""
        ...

    def lost(self, pose: Pose) -> str:
        """Why it can guide no further without seeing rows, in words; empty while it can."""
        ...
