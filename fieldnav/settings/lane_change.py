"""What a crop profile says of lanes: when one ends, how the next one is told, and how it is entered."""

from typing import Annotated

from pydantic import Field

from fieldnav.settings.model import Settings

Seconds = Annotated[float, Field(gt=0, le=60)]


class RowEnd(Settings):
    """When following and exit end (paper III-A.3), as a decision over time and distance."""

    confirm_s: Seconds = 0.4
    confirm_m: float = Field(default=0.15, gt=0, le=3)
    exit_confirm_s: Seconds = Field(
        default=0.1,
        description="the same when leaving; the leading camera has seen no row for metres by then",
    )
    exit_confirm_m: float = Field(
        default=0.03,
        gt=0,
        le=1,
        description="every centimetre more is less of the rows left to see and to count",
    )
    least_crop: float = Field(
        default=0.1, ge=0, le=5, description="crop in half a view that is still a row; 1 is one full row"
    )
    longest_gap_m: float = Field(
        default=2.0,
        ge=0,
        le=10,
        description="how far the robot coasts on without seeing the rows before it stops with a fault",
    )


class Recognition(Settings):
    """Paper III-C: telling a new row from the same one by SIFT features."""

    match_ratio: float = Field(
        default=0.0, ge=0, le=2000, description="lambda: matches at or below are left out"
    )
    new_row_distance: float = Field(
        default=295.0, gt=0, le=2000, description="tau: mean distance of a new row's matches"
    )
    confirm_frames: int = Field(default=3, ge=1, le=100)


class Switching(Settings):
    """The sidestep to the next lane: how far it may go and how well it must end."""

    longest_sidestep_m: float = Field(default=2.5, gt=0.2, le=6)
    centred_m: float = Field(
        default=0.02, gt=0, le=0.2, description="the new lane counts as centred within this"
    )
    aligned_deg: float = Field(default=1.5, gt=0, le=10, description="and as aligned within this")
