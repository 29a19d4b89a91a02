"""What a crop profile says of lanes: when one ends, how the next one is told, and how it is entered."""

from pydantic import Field

from fieldnav.settings.model import Settings


class RowEnd(Settings):
    """How a lane's end is told from a gap in it: by probability, over distance (paper III-A.3)."""

    longest_gap_m: float = Field(
        default=2.5,
        ge=0,
        le=10,
        description="of all rows at once; so far the robot goes on without rows before it stops with a fault",
    )


class Recognition(Settings):
    """Telling a new row from the same one by SIFT features (paper III-C)."""

    new_row_share: float = Field(
        default=0.05,
        gt=0,
        le=1,
        description="a row is new when less than this share of its features moved together",
    )
    match_ratio: float = Field(
        default=0.0, ge=0, le=2000, description="lambda: matches at or below are left out"
    )
    new_row_distance: float = Field(
        default=315.0,
        gt=0,
        le=2000,
        description="tau: mean distance of a new row's matches; the paper's measure, specific to a crop",
    )
    confirm_frames: int = Field(default=3, ge=1, le=100)


class Switching(Settings):
    """The sidestep to the next lane: how far it may go, how well it must end, how often it is tried."""

    headland_m: float = Field(
        default=0.35, ge=0.1, le=2, description="from the last crop to the trailing camera at the sidestep"
    )
    longest_sidestep_m: float = Field(default=2.5, gt=0.2, le=6)
    centred_m: float = Field(
        default=0.02, gt=0, le=0.2, description="the new lane counts as centred within this"
    )
    aligned_deg: float = Field(default=1.5, gt=0, le=10, description="and as aligned within this")
    attempts: int = Field(
        default=2, ge=1, le=5, description="so often the next lane is looked for before the robot stops"
    )
    crop_clearance_m: float = Field(
        default=0.2,
        ge=0.0,
        le=1,
        description="moving sideways, crop is kept so far beyond the trailing camera; wheels run behind it",
    )
    longest_retreat_m: float = Field(
        default=0.6, ge=0, le=2, description="and so far the robot moves away from it at most"
    )
