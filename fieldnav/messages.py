"""The values that travel through the loop.

Axes, everywhere: the robot's x points forward, y left, yaw counter-clockwise; the image's x right, y down.
Lengths are metres, angles radians, times seconds, positions in an image pixels from its upper left corner.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from fieldnav.faults import Trouble

Image = NDArray[np.uint8]
"""A colour image, shape (height, width, 3), channels blue, green, red."""

Floats = NDArray[np.float64]


class CameraName(Enum):
    """The two cameras; which of them leads depends on the direction of travel."""

    FRONT = "front"
    REAR = "rear"

    @property
    def opposite(self) -> "CameraName":
        return CameraName.REAR if self is CameraName.FRONT else CameraName.FRONT


class Direction(Enum):
    """The direction of travel along a lane; `sign` multiplies the robot's x axis."""

    FORWARD = "Forward"
    BACKWARD = "Backward"

    @property
    def sign(self) -> int:
        return 1 if self is Direction.FORWARD else -1

    @property
    def opposite(self) -> "Direction":
        return Direction.BACKWARD if self is Direction.FORWARD else Direction.FORWARD

    @property
    def leading(self) -> CameraName:
        """The camera that looks where the robot goes."""
        return CameraName.FRONT if self is Direction.FORWARD else CameraName.REAR

    @property
    def trailing(self) -> CameraName:
        """The camera that looks where the robot comes from."""
        return self.leading.opposite


class Side(Enum):
    """A side of the robot; `sign` multiplies the robot's y axis."""

    LEFT = "left"
    RIGHT = "right"

    @property
    def sign(self) -> int:
        return 1 if self is Side.LEFT else -1


class Wheel(Enum):
    """The four wheel modules, named by their place on the robot."""

    REAR_RIGHT = "rear_right"
    FRONT_RIGHT = "front_right"
    FRONT_LEFT = "front_left"
    REAR_LEFT = "rear_left"

    __hash__ = object.__hash__  # Enum hashes a member's name in Python, at every look into a dict


@dataclass(frozen=True, slots=True)
class Frame:
    """One picture of one camera; `stamp_s` is when it was taken, `sequence` counts the camera's frames.

    jpeg: what the picture was decoded from, if it was compressed.
    """

    camera: CameraName
    sequence: int
    stamp_s: float
    image: Image
    jpeg: bytes | None = None


@dataclass(frozen=True, slots=True)
class Twist:
    """Velocity of the robot's body in its own axes."""

    vx_mps: float = 0.0
    vy_mps: float = 0.0
    yaw_rate_rps: float = 0.0


STANDSTILL = Twist()


class Steering(Enum):
    """How a twist is turned into wheel commands.

    DIFFERENTIAL keeps the wheels straight and yaws by unequal speeds (within the rows);
    OMNIDIRECTIONAL turns every wheel perpendicular to its line from the instantaneous centre of rotation.
    """

    DIFFERENTIAL = "differential"
    OMNIDIRECTIONAL = "omnidirectional"


@dataclass(frozen=True, slots=True)
class Motion:
    """What a state wants of the wheels; with `hold` the wheels only turn into place and stand still."""

    twist: Twist = STANDSTILL
    steering: Steering = Steering.DIFFERENTIAL
    hold: bool = False


@dataclass(frozen=True, slots=True)
class WheelSetpoint:
    """Command for one module: rim speed and steering angle, 0 straight ahead, positive to the left."""

    speed_mps: float
    steering_rad: float


@dataclass(frozen=True, slots=True)
class ModuleReport:
    """What one module last said; `stamp_s` is when its motion frame arrived, `trouble` what is not well."""

    stamp_s: float
    speed_mps: float
    steering_rad: float
    trouble: Trouble | None = None
    temperature_c: float = 0.0
    battery_v: float = 0.0

    @property
    def healthy(self) -> bool:
        return self.trouble is None


@dataclass(frozen=True, slots=True)
class WheelReport:
    """The modules' newest words, a module never heard of is absent; the battery's charge in percent."""

    modules: Mapping[Wheel, ModuleReport] = field(default_factory=dict)
    charge_percent: float | None = None


class Bound(Enum):
    """On which side of its threshold a quantity has to lie for its event."""

    AT_LEAST = ">="
    ABOVE = ">"
    AT_MOST = "<="
    BELOW = "<"

    @property
    def sign(self) -> int:
        """+1 where more is wanted, -1 where less is."""
        return 1 if self in (Bound.AT_LEAST, Bound.ABOVE) else -1

    def holds(self, value: float, threshold: float) -> bool:
        """Whether the condition holds; one of which a side is no number does not."""
        past = self.sign * (value - threshold)
        return past >= 0 if self in (Bound.AT_LEAST, Bound.AT_MOST) else past > 0


@dataclass(frozen=True, slots=True)
class Evidence:
    """One quantity a state judged: its value, the threshold it was held against, the unit of both.

    fires: the event that it is a condition of, with `bound` the side that the threshold wants. An event comes
    about when all of its conditions hold; or one that is enough `alone`.
    """

    name: str
    value: float
    threshold: float | None = None
    unit: str = ""
    fires: Enum | None = None
    bound: Bound = Bound.AT_LEAST
    alone: bool = False


@dataclass(frozen=True, slots=True)
class RowLine:
    """A crop row in an image: x = x_top + (x_bottom - x_top) * y / (height - 1), all in pixels.

    `confidence` lies within 0 and 1; a row kept from an earlier frame has 0.
    """

    x_top_px: float
    x_bottom_px: float
    confidence: float = 1.0

    def at(self, y_px: float, last_px: float) -> float:
        """Where the row lies at one image row; last_px: the last of them."""
        if not y_px:
            return self.x_top_px
        return self.x_top_px + (self.x_bottom_px - self.x_top_px) * y_px / last_px


@dataclass(frozen=True, slots=True)
class Centres:
    """The plants found in an image.

    position_px: shape (n, 2), float, x and y of the centres of mass; area_px: shape (n,), float;
    top_px and bottom_px: shape (n,), float, the first and last image row that the region covers.
    """

    position_px: Floats
    area_px: Floats
    top_px: Floats
    bottom_px: Floats

    def __len__(self) -> int:
        return len(self.area_px)
