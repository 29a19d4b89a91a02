"""What goes into a recording: messages on topics, and what becomes messages once it is written."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from fieldnav.messages import CameraName


class Topic(Enum):
    """The topics of a recording, as Foxglove lists them."""

    ROUND = "/mission/round"
    TICK = "/mission/tick"
    STEP = "/mission/step"
    TRANSITION = "/mission/transition"
    LOG = "/log"
    POSE = "/robot/pose"
    GAP = "/recording/gap"
    FRONT_IMAGE = "/camera/front/image"
    REAR_IMAGE = "/camera/rear/image"
    FRONT_OVERLAY = "/camera/front/overlay"
    REAR_OVERLAY = "/camera/rear/overlay"
    FRONT_CALIBRATION = "/camera/front/calibration"
    REAR_CALIBRATION = "/camera/rear/calibration"

    @staticmethod
    def image(camera: CameraName) -> "Topic":
        """The topic of a camera's pictures."""
        return Topic.FRONT_IMAGE if camera is CameraName.FRONT else Topic.REAR_IMAGE

    @staticmethod
    def overlay(camera: CameraName) -> "Topic":
        """The topic of what is drawn over a camera's pictures."""
        return Topic.FRONT_OVERLAY if camera is CameraName.FRONT else Topic.REAR_OVERLAY

    @staticmethod
    def calibration(camera: CameraName) -> "Topic":
        """The topic of how a camera sees."""
        return Topic.FRONT_CALIBRATION if camera is CameraName.FRONT else Topic.REAR_CALIBRATION


@dataclass(frozen=True, slots=True)
class Message:
    """One message as it is written; `stamp_s` in the run's seconds, `sequence`: of a picture's frame."""

    topic: Topic
    stamp_s: float
    data: bytes
    sequence: int = 0


class Recordable(Protocol):
    """What waits to be recorded.

    size: bytes of memory that it holds meanwhile; picture: it may be left out when the queue is full.
    """

    @property
    def size(self) -> int: ...

    @property
    def picture(self) -> bool: ...

    def messages(self) -> Iterable[Message]:
        """What it becomes; called on the writer's own thread, so that the loop does not pay for it."""
        ...
