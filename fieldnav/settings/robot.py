"""Robot file: geometry, wheel modules, cameras, bus, limits and timeouts of one machine."""

from math import pi
from typing import Literal, Self

from pydantic import Field, model_validator

from fieldnav.messages import Wheel
from fieldnav.settings.camera import CameraLimits, Cameras
from fieldnav.settings.model import FileName, Settings
from fieldnav.settings.recording import RecordingSettings


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


class Bus(Settings):
    """The CAN bus, as python-can opens it."""

    interface: str
    channel: str
    bitrate: int = Field(default=500_000, ge=10_000, le=1_000_000)
    options: dict[str, str | int | float | bool] = Field(
        default_factory=dict, description="more that the interface wants, say host and port of socketcand"
    )


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


class Timeouts(Settings):
    """Silence that is borne no longer."""

    frame_s: float = Field(default=0.5, gt=0, le=5, description="age of a frame past which it is stale")
    command_s: float = Field(default=0.5, gt=0, le=5, description="no velocity command: speed zero")
    motion_s: float = Field(
        default=0.2, gt=0, le=2, description="no motion report of a module: the wheels are held"
    )
    module_s: float = Field(default=2.0, gt=0, le=10, description="no frame of a module: connection lost")
    heartbeat_s: float = Field(default=0.1, gt=0, le=1, description="period of the host's heartbeat")
    loop_s: float = Field(default=0.1, gt=0, le=1, description="between two rounds of the loop")


class Battery(Settings):
    """When the battery is too flat to go on."""

    least_charge: float = Field(default=10.0, ge=0, le=100, description="percent; below it the robot stops")


class Robot(Settings):
    """One machine."""

    name: FileName
    geometry: Geometry
    modules: dict[Wheel, Module]
    cameras: Cameras
    can: Bus
    limits: Limits
    timeouts: Timeouts = Timeouts()
    battery: Battery = Battery()
    recording: RecordingSettings = RecordingSettings()
    camera_limits: CameraLimits = CameraLimits()

    @model_validator(mode="after")
    def _four_modules(self) -> Self:
        if set(self.modules) != set(Wheel):
            raise ValueError(f"modules must name each of {', '.join(wheel.value for wheel in Wheel)}")
        if len({module.node_id for module in self.modules.values()}) != len(Wheel):
            raise ValueError("modules must have four different node ids")
        return self
