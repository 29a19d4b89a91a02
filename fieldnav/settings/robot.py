"""Robot file: geometry, wheel modules, cameras, bus, limits and timeouts of one machine."""

from math import atan, ceil, degrees, pi, radians, tan
from typing import Literal, Self

from pydantic import Field, model_validator

from fieldnav.messages import CameraName, Wheel
from fieldnav.pinhole import Pinhole
from fieldnav.settings.model import FileName, Settings

HORIZON_MARGIN_DEG = 5.0
"""Chosen: the image's upper edge looks so far below the horizon, at ground within 11 camera heights."""
STEEPEST_TILT_DEG = 90
LARGEST_SIDE_PX = 8192


class Geometry(Settings):
    """Where the wheels stand; x forward, y left, from the centre of rotation."""

    track_m: float = Field(ge=0.3, le=4)
    wheelbase_m: float = Field(ge=0.3, le=4)
    length_m: float = Field(ge=0.3, le=5)
    clearance_m: float = Field(ge=0.1, le=3)
    wheel_width_m: float = Field(default=0.16, ge=0.02, le=1)

    def position_m(self, wheel: Wheel) -> tuple[float, float]:
        """A wheel's (x, y) on the robot."""
        front = wheel in (Wheel.FRONT_LEFT, Wheel.FRONT_RIGHT)
        left = wheel in (Wheel.FRONT_LEFT, Wheel.REAR_LEFT)
        return (
            self.wheelbase_m / 2 if front else -self.wheelbase_m / 2,
            self.track_m / 2 if left else -self.track_m / 2,
        )


class Module(Settings):
    """One drive-and-steer module; every constant is per module because one known robot mixes encoders."""

    node_id: int = Field(ge=1, le=127)
    wheel_radius_m: float = Field(default=0.2, ge=0.05, le=1)
    drive_gear: float = Field(default=42.0, ge=1, le=500)
    motor_max_rpm: float = Field(default=3000.0, ge=100, le=20000)
    steering_gear: float = Field(default=42.857, ge=1, le=500)
    encoder_pulses: int = Field(default=1024, ge=1, le=100000)
    steering_limit_rad: float = Field(default=3.078, gt=0.1, le=6.3)
    drive_direction: Literal[-1, 1] = 1
    home_count: int = Field(default=0, ge=-(2**31), le=2**31 - 1)

    @property
    def top_speed_mps(self) -> float:
        """Rim speed at the motor's top speed: v = rpm / gear * 2 pi / 60 * radius."""
        return self.motor_max_rpm / self.drive_gear * pi / 30 * self.wheel_radius_m


class CameraSettings(Settings):
    """One camera: its source and size, and where it sits."""

    source: str
    width_px: int = Field(ge=64, le=LARGEST_SIDE_PX)
    height_px: int = Field(ge=48, le=LARGEST_SIDE_PX)
    rate_hz: float = Field(gt=0, le=240)
    horizontal_fov_deg: float = Field(ge=10, le=150)
    height_m: float = Field(ge=0.2, le=5)
    tilt_deg: float = Field(ge=20, le=STEEPEST_TILT_DEG, description="below the horizontal")
    distance_m: float = Field(
        ge=0, le=3, description="from the centre of rotation, in the direction the camera looks"
    )

    @model_validator(mode="after")
    def _sees_ground_alone(self) -> Self:
        """The horizon is nowhere on the ground, and rows that reach up to it have no end."""
        least_deg = HORIZON_MARGIN_DEG + degrees(atan(self.height_px / 2 / self._focal_px))
        if self.tilt_deg < least_deg:
            view = f"horizontal_fov_deg {self.horizontal_fov_deg:g} at {self.width_px}x{self.height_px} px"
            allowed = f"at least {ceil(least_deg)}" if least_deg <= STEEPEST_TILT_DEG else "a less tall view"
            raise ValueError(
                f"tilt_deg {self.tilt_deg:g} with {view} looks at the horizon; allowed is {allowed}"
            )
        return self

    @property
    def _focal_px(self) -> float:
        return self.width_px / 2 / tan(radians(self.horizontal_fov_deg) / 2)

    def pinhole(self) -> Pinhole:
        tilt_rad = radians(self.tilt_deg)
        return Pinhole(
            self.width_px, self.height_px, self._focal_px, self.height_m, tilt_rad, self.distance_m
        )


class Cameras(Settings):
    """The front and the rear camera."""

    front: CameraSettings
    rear: CameraSettings

    def get(self, name: CameraName) -> CameraSettings:
        return self.front if name is CameraName.FRONT else self.rear


class Bus(Settings):
    """The CAN bus, as python-can opens it."""

    interface: str
    channel: str
    bitrate: int = Field(default=500_000, ge=10_000, le=1_000_000)


class Limits(Settings):
    """What the gate never lets through."""

    speed_mps: float = Field(gt=0, le=3)
    acceleration_mps2: float = Field(default=0.8, gt=0, le=5)
    yaw_rate_rps: float = Field(default=0.5, gt=0, le=3)
    yaw_acceleration_rps2: float = Field(default=1.5, gt=0, le=10)
    steering_rate_rps: float = Field(default=1.5, gt=0, le=10)
    wheel_inversion_deg: float = Field(default=90.0, ge=60, le=120)
    wheel_inversion_hysteresis_deg: float = Field(default=10.0, ge=0, le=40)
    steering_aligned_deg: float = Field(
        default=4.0, gt=0, le=30, description="wheels count as turned within this"
    )


class CameraLimits(Settings):
    """How far a camera may look away from its file's values, by what the rows tell, before it is reported."""

    tilt_deg: float = Field(
        default=4.0,
        gt=0,
        le=30,
        description="mounting and lens hide 2 degrees, and rows tell no better than to 1",
    )
    height_m: float = Field(
        default=0.15,
        gt=0,
        le=2,
        description="rows sown a little closer than the profile has them look like 0.08 m",
    )
    yaw_deg: float = Field(
        default=6.0,
        gt=0,
        le=45,
        description="against the rows; in a bend of 25 m radius they lie 3 degrees aside",
    )


class Timeouts(Settings):
    """Silence that is borne no longer."""

    frame_s: float = Field(default=0.5, gt=0, le=5, description="age of a frame past which it is stale")
    command_s: float = Field(default=0.5, gt=0, le=5, description="no velocity command: speed zero")
    module_s: float = Field(default=2.0, gt=0, le=10, description="no frame of a module: connection lost")
    heartbeat_s: float = Field(default=0.1, gt=0, le=1, description="period of the host's heartbeat")


class Robot(Settings):
    """One machine."""

    name: FileName
    geometry: Geometry
    modules: dict[Wheel, Module]
    cameras: Cameras
    can: Bus
    limits: Limits
    timeouts: Timeouts = Timeouts()
    camera_limits: CameraLimits = CameraLimits()

    @model_validator(mode="after")
    def _four_modules(self) -> Self:
        if set(self.modules) != set(Wheel):
            raise ValueError(f"modules must name each of {', '.join(wheel.value for wheel in Wheel)}")
        if len({module.node_id for module in self.modules.values()}) != len(Wheel):
            raise ValueError("modules must have four different node ids")
        return self
