"""Part of the field file: how the rows run, where plants are missing from them, and which were never sown.

Lanes and rows count from 1 in a file: lanes in the order in which they are driven, the rows of a lane from
right to left for one who looks along the first lane's way. In a mirrored field what was named so is mirrored.
"""

from enum import Enum
from typing import Annotated

from pydantic import AfterValidator, Field

from fieldnav.settings.model import Settings

MOST_LANES, MOST_ROWS = 100, 20
ALL_ROWS = 0


def ascending(span: tuple[float, float]) -> tuple[float, float]:
    """A span whose two numbers are in order. Raises ValueError."""
    if span[0] > span[1]:
        raise ValueError("allowed is a smaller number first, then a larger one")
    return span


GapLength = Annotated[float, Field(ge=0.05, le=20)]
LaneNumber = Annotated[int, Field(ge=1, le=MOST_LANES)]
RowNumber = Annotated[int, Field(ge=1, le=MOST_ROWS, description="the lane's rightmost row is 1")]


class Shape(Enum):
    STRAIGHT = "straight"
    CURVED = "curved"


class Rows(Settings):
    """How far the rows are from a ruler's line."""

    shape: Shape = Shape.STRAIGHT
    radius_m: float = Field(
        default=25.0,
        ge=8,
        le=1000,
        description="tightest radius of a curved field's first lane; a lane inside of it bends tighter by "
        "its distance",
    )
    wavelength_m: float = Field(default=40.0, ge=10, le=500, description="length of one left and right bend")
    wander_m: float = Field(default=0.02, ge=0, le=0.2, description="rms departure from straight")
    wander_length_m: float = Field(default=5.0, ge=1, le=50)
    scatter_m: float = Field(default=0.015, ge=0, le=0.1, description="rms distance of a plant from its row")
    spacing_error: float = Field(default=0.0, ge=0, le=0.3, description="uneven row distances, as a fraction")
    pass_error_m: float = Field(
        default=0.05, ge=0, le=0.2, description="each lane lies within plus or minus this of its place"
    )
    ragged_m: float = Field(default=0.1, ge=0, le=0.5, description="row ends lie within plus or minus this")


class PlacedGap(Settings):
    """A stretch that is empty on purpose, of one row or of all rows of a lane."""

    lane: LaneNumber
    row: int = Field(
        default=ALL_ROWS,
        ge=ALL_ROWS,
        le=MOST_ROWS,
        description="the lane's rightmost row is 1; 0 or left out: all rows",
    )
    start_m: float = Field(ge=0, le=2000, description="along the lane, from the field's start")
    length_m: float = Field(ge=0.05, le=2000)


class Gaps(Settings):
    """Stretches without plants."""

    germination: float = Field(default=0.95, gt=0.1, le=1)
    row_gaps_per_10m: float = Field(default=0.3, ge=0, le=5, description="in one row")
    row_gap_m: Annotated[tuple[GapLength, GapLength], AfterValidator(ascending)] = (0.4, 1.0)
    lane_gaps_per_10m: float = Field(default=0.0, ge=0, le=1, description="in all rows of a lane at once")
    lane_gap_m: Annotated[tuple[GapLength, GapLength], AfterValidator(ascending)] = (0.5, 1.0)
    placed: tuple[PlacedGap, ...] = ()


class UnsownRow(Settings):
    """A row that the drill left out."""

    lane: LaneNumber
    row: RowNumber


class Unsown(Settings):
    """What the drill left out from end to end."""

    lanes: tuple[LaneNumber, ...] = ()
    rows: tuple[UnsownRow, ...] = ()
