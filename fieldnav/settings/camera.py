"""Robot file: the cameras, where they sit, and how far they may be knocked away from there."""

from math import atan, ceil, degrees, radians, tan
from typing import Self

from pydantic import Field, model_validator

from fieldnav.messages import CameraName
from fieldnav.pinhole import Pinhole
from fieldnav.settings.model import Settings

HORIZON_MARGIN_DEG = 5.0
"""Chosen: the image's upper edge looks so far below the horizon, at ground within 11 camera heights."""
STEEPEST_TILT_DEG = 90
LARGEST_SIDE_PX = 8192


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
    latency_s: float = Field(
        default=0.07, ge=0, le=0.5, description="from exposure until a live camera's frame is here"
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

    def pinholes(self) -> dict[CameraName, Pinhole]:
        """How each of them sees."""
        return {name: self.get(name).pinhole() for name in CameraName}


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
