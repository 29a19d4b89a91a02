"""Crop profile: everything about a crop that the robot must know, in metres rather than pixels."""

from enum import Enum
from math import radians
from typing import Annotated

from pydantic import Field

from fieldnav.messages import Steering
from fieldnav.settings.lane_change import Recognition, RowEnd, Switching
from fieldnav.settings.model import FileName, Settings

Fraction = Annotated[float, Field(ge=0, le=1)]


class VegetationIndex(Enum):
    """How green a pixel is; excess green: 2g - r - b of brightness-normalised channels (Woebbecke 1995)."""

    EXCESS_GREEN = "excess_green"


class RowFinder(Enum):
    """The method that finds rows in a fresh frame: the paper's, or a comb that explains it best.

    The comb is fitted to vegetation, or to what the network sees.
    """

    MOVING_VARIANCE = "moving_variance"
    COMB = "comb"
    NETWORK = "network"


class Rows(Settings):
    """How the crop is sown: rows under the robot and the distance between them."""

    per_lane: int = Field(ge=1, le=8)
    spacing_m: float = Field(ge=0.1, le=1.5)
    lane_pitch_m: float | None = Field(
        default=None, ge=0.5, le=5, description="from lane to lane as drilled; null: learnt from the switches"
    )


class Plants(Settings):
    """How a plant of this crop stands at this growth stage."""

    spacing_m: float = Field(ge=0.01, le=1.5, description="distance between plants within the row")
    canopy_width_m: float = Field(ge=0.02, le=1.2)
    canopy_height_m: float = Field(ge=0.02, le=0.86, description="below the robot's clearance of 0.86 m")


class Vegetation(Settings):
    """Paper III-A.1: excess green, Otsu's threshold, connected regions, centres of mass."""

    index: VegetationIndex = VegetationIndex.EXCESS_GREEN
    floor: float = Field(
        default=0.08, ge=0, le=1, description="index below which a pixel is never a plant, 0 to 1"
    )
    smallest_area_m2: float = Field(default=0.0002, ge=0, le=0.1)
    tallest_region_m: float = Field(default=0.25, ge=0.02, le=2, description="taller regions are divided")


class Finding(Settings):
    """The finder, and the paper's sliding window and field-structure signal (III-A.2)."""

    method: RowFinder = RowFinder.COMB
    window: float = Field(
        default=0.1, gt=0.01, le=0.5, description="window width over image width (paper: W/10)"
    )
    stride: float = Field(
        default=13 / 1280, gt=0.001, le=0.1, description="stride over image width (paper: 13 px)"
    )
    neighbours: int = Field(default=10, ge=2, le=100, description="k of the moving variance (paper: 10)")
    prominence_deg2: float = Field(default=6.0, gt=0, le=500, description="of the peaks and troughs")
    second_witness: bool = Field(
        default=True,
        description="whether the network must bear out the rows; false: what the method finds is believed",
    )


class Tracking(Settings):
    """Paper III-A.3: the parallelogram on each row."""

    narrowest: Fraction = Field(default=0.05, description="parallelogram width over image width (paper: 5 %)")
    fewest_centres: int = Field(default=2, ge=2, le=50)


class Speeds(Settings):
    """Working speeds; the robot's own limits hold in any case."""

    follow_mps: float = Field(default=0.5, gt=0, le=1.5)
    acquire_mps: float = Field(default=0.2, gt=0, le=1.0)
    exit_mps: float = Field(default=0.5, gt=0, le=1.0)
    sidestep_mps: float = Field(default=0.15, gt=0, le=0.5)


class ControlLaw(Enum):
    """How a lane is followed: by the paper's visual servoing, or along its path estimated in metres."""

    PAPER = "paper"
    PATH_FOLLOWING = "path_following"


class Control(Settings):
    """How the robot is held on the lane; lengths are those over which an error falls to a third."""

    law: ControlLaw = ControlLaw.PATH_FOLLOWING
    steering: Steering = Field(
        default=Steering.OMNIDIRECTIONAL,
        description="omnidirectional: all wheels steer; differential: they stay straight within the rows",
    )
    offset_length_m: float = Field(default=0.7, ge=0.2, le=5)
    heading_length_m: float = Field(default=0.7, ge=0.2, le=5)
    steepest_crab_deg: float = Field(
        default=15.0, ge=1, le=45, description="the most that it travels at an angle to its heading"
    )
    most_uncertain_m: float = Field(
        default=0.08, ge=0.01, le=0.5, description="offset's standard deviation at which it stops in a gap"
    )

    @property
    def steepest_crab_rad(self) -> float:
        return radians(self.steepest_crab_deg)


class Servoing(Settings):
    """How fast the visual servoing (paper III-B) brings the robot onto the lane, per metre driven."""

    convergence_m: float = Field(default=0.7, ge=0.1, le=5, description="natural length of the closed loop")
    exit_convergence_m: float = Field(
        default=1.5,
        ge=0.1,
        le=5,
        description="the same behind the trailing camera, where an error of angle counts five times as much",
    )
    damping: float = Field(default=1.0, ge=0.3, le=3)

    @property
    def leaving(self) -> "Servoing":
        """The servoing of the exit."""
        return self.model_copy(update={"convergence_m": self.exit_convergence_m})


class CropProfile(Settings):
    """A crop at a growth stage, and how to see and follow it."""

    name: FileName
    growth_stage: str = Field(min_length=1, description="in words, with the BBCH code")
    rows: Rows
    plants: Plants
    vegetation: Vegetation = Vegetation()
    finding: Finding = Finding()
    tracking: Tracking = Tracking()
    row_end: RowEnd = RowEnd()
    recognition: Recognition = Recognition()
    switching: Switching = Switching()
    speeds: Speeds = Speeds()
    control: Control = Control()
    servoing: Servoing = Servoing()
    tuned_for: str = Field(min_length=1, description="the range of conditions this profile was tuned for")
