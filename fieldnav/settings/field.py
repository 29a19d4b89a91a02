"""Field file: the world a simulated run happens in, and how hard it is made. Used by the simulation alone."""

from typing import Annotated

from pydantic import AfterValidator, Field

from fieldnav.settings.field_cover import GrassEdge, Weeds
from fieldnav.settings.field_rows import (
    ALL_ROWS,
    MOST_LANES,
    Gaps,
    PlacedGap,
    Rows,
    Shape,
    Unsown,
    UnsownRow,
    ascending,
)
from fieldnav.settings.model import FileName, Settings

__all__ = [
    "ALL_ROWS",
    "CameraErrors",
    "FieldSettings",
    "Gaps",
    "GrassEdge",
    "Ground",
    "Light",
    "PlacedGap",
    "Rows",
    "Shape",
    "Start",
    "Unsown",
    "UnsownRow",
    "Weeds",
    "WheelErrors",
]

Frequency = Annotated[float, Field(ge=0.05, le=20)]
Grey = Annotated[int, Field(ge=0, le=255)]


class Light(Settings):
    """Sun and sky."""

    sun_elevation_deg: float = Field(default=50.0, ge=5, le=90)
    sun_azimuth_deg: float = Field(
        default=120.0, ge=-360, le=360, description="counter-clockwise from the lanes' x"
    )
    sunshine: float = Field(default=0.7, ge=0, le=1, description="0 overcast, 1 clear sky with hard shadows")


class Ground(Settings):
    """Soil."""

    colour_bgr: tuple[Grey, Grey, Grey] = (72, 96, 122)
    roughness: float = Field(default=0.5, ge=0, le=1)
    residue: float = Field(default=0.1, ge=0, le=1, description="cover of straw and stalks")
    stones: float = Field(default=0.1, ge=0, le=1)
    side_slope_deg: float = Field(default=2.0, ge=-10, le=10, description="positive: the left side is higher")
    slip: float = Field(default=0.02, ge=0, le=0.3)


class CameraErrors(Settings):
    """What the cameras do that their file does not say."""

    shake_deg: float = Field(default=1.0, ge=0, le=5, description="rms of roll and of pitch")
    shake_hz: Annotated[tuple[Frequency, Frequency], AfterValidator(ascending)] = (1.0, 2.0)
    bounce_m: float = Field(default=0.02, ge=0, le=0.1, description="height, plus or minus")
    tilt_error_deg: float = Field(default=1.5, ge=0, le=10, description="calibration, plus or minus")
    height_error_m: float = Field(default=0.03, ge=0, le=0.2)
    focal_error: float = Field(default=0.02, ge=0, le=0.2)
    yaw_error_deg: float = Field(default=0.3, ge=0, le=5, description="calibration, plus or minus")
    latency_s: float = Field(default=0.07, ge=0, le=0.5)
    lost_frames: float = Field(default=0.01, ge=0, le=0.5)
    exposure_s: float = Field(default=0.004, ge=0, le=0.03, description="motion blur")
    noise: float = Field(default=3.0, ge=0, le=30, description="standard deviation in grey levels")
    vignetting: float = Field(default=0.25, ge=0, le=0.8, description="darkening of the corners")
    exposure_drift: float = Field(default=0.1, ge=0, le=0.5)


class WheelErrors(Settings):
    """What the wheel modules do that they were not told."""

    speed_error: float = Field(default=0.02, ge=0, le=0.2, description="per module, plus or minus")
    steering_zero_deg: float = Field(default=0.5, ge=0, le=5, description="per module, plus or minus")
    can_delay_s: float = Field(default=0.005, ge=0, le=0.1)


class Start(Settings):
    """How the robot is set down at its first lane; drawn within plus or minus these."""

    offset_m: float = Field(default=0.04, ge=0, le=0.3)
    heading_deg: float = Field(default=2.0, ge=0, le=15)


class FieldSettings(Settings):
    """A simulated field. `mirrored` swaps left and right of the finished world."""

    name: FileName
    crop: str = Field(min_length=1, description="name of a shipped crop profile, or the path of one")
    lanes: int = Field(ge=1, le=MOST_LANES)
    length_m: float = Field(ge=4, le=2000)
    lane_pitch_m: float = Field(default=1.5, ge=0.5, le=5)
    seed: int = Field(default=1, ge=0, le=2**31 - 1)
    mirrored: bool = False
    rows: Rows = Rows()
    gaps: Gaps = Gaps()
    unsown: Unsown = Unsown()
    weeds: Weeds = Weeds()
    grass_edge: GrassEdge = GrassEdge()
    light: Light = Light()
    wind_mps: float = Field(default=2.0, ge=0, le=15)
    ground: Ground = Ground()
    camera_errors: CameraErrors = CameraErrors()
    wheel_errors: WheelErrors = WheelErrors()
    start: Start = Start()
