"""Robot file: the cameras, where they sit, and how far they may be knocked away from there."""

from dataclasses import replace
from math import atan, degrees, radians, tan
from typing import Self

from pydantic import Field, model_validator

from fieldnav.messages import CameraName
from fieldnav.pinhole import Pinhole
from fieldnav.settings.model import Settings

FURTHEST_DEG, FURTHEST_M = 10.0, 8.0
"""Chosen: ground counts that is so far below the horizon, within 5.7 camera heights, and no further away. A
camera that hangs 1.5 degrees otherwise than its file says places ground a camera height too far there, at 5
degrees five; and where a lane ends is decided by 8 m of it."""
MIN_TILT_DEG, MAX_TILT_DEG = 10, 90
MAX_VIEW_DEG = 150
LARGEST_SIDE_PX = 8192


class CameraSettings(Settings):
    """One camera: its source and size, and where it sits."""

    source: str
    width_px: int = Field(ge=64, le=LARGEST_SIDE_PX)
    height_px: int = Field(ge=48, le=LARGEST_SIDE_PX)
    rate_hz: float = Field(gt=0, le=240)
    horizontal_fov_deg: float = Field(ge=10, le=MAX_VIEW_DEG)
    height_m: float = Field(ge=0.2, le=5)
    tilt_deg: float = Field(
        ge=MIN_TILT_DEG,
        le=MAX_TILT_DEG,
        description="of the optical axis below the horizontal; the horizon may be in view",
    )
    distance_m: float = Field(
        ge=0, le=3, description="from the centre of rotation, in the direction the camera looks"
    )
    latency_s: float = Field(
        default=0.07, ge=0, le=0.5, description="from exposure until a live camera's frame is here"
    )

    @model_validator(mode="after")
    def _horizon_in_no_all_round_view(self) -> Self:
        """A view that holds the horizon in front must not come near to the one behind."""
        high_deg = 2 * self._half_view_deg
        if self._looks_at_horizon and high_deg > MAX_VIEW_DEG:
            view = f"horizontal_fov_deg {self.horizontal_fov_deg:g} at {self.width_px}x{self.height_px} px"
            raise ValueError(
                f"tilt_deg {self.tilt_deg:g} with {view} looks at the horizon and is {high_deg:.0f} degrees "
                f"high; allowed is at most {MAX_VIEW_DEG}"
            )
        return self

    @property
    def _focal_px(self) -> float:
        return self.width_px / 2 / tan(radians(self.horizontal_fov_deg) / 2)

    @property
    def _half_view_deg(self) -> float:
        """From the optical axis to the image's upper or lower edge."""
        return degrees(atan(self.height_px / 2 / self._focal_px))

    @property
    def _looks_at_horizon(self) -> bool:
        """Whether the upper edge looks at the horizon or above it."""
        return self.tilt_deg <= self._half_view_deg

    def pinhole(self) -> Pinhole:
        tilt_rad = radians(self.tilt_deg)
        camera = Pinhole(
            self.width_px, self.height_px, self._focal_px, self.height_m, tilt_rad, self.distance_m
        )
        below_rad = max(radians(FURTHEST_DEG), atan(self.height_m / FURTHEST_M))
        return replace(camera, top_px=max(0.0, camera.seen_at_px(min(below_rad, tilt_rad))))


class Cameras(Settings):
    """The front and the rear camera."""

    front: CameraSettings
    rear: CameraSettings

    def get(self, name: CameraName) -> CameraSettings:
        return self.front if name is CameraName.FRONT else self.rear

    def pinholes(self) -> dict[CameraName, Pinhole]:
        """How each of them sees."""
        return {name: self.get(name).pinhole() for name in CameraName}

    def skies_px(self) -> dict[CameraName, float]:
        """How many image rows of each of them look above the horizon."""
        return {name: camera.sky_px for name, camera in self.pinholes().items()}


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
