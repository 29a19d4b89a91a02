"""Whether a fresh look at the new lane shows what passed: its rows, their spacing and place, none beside."""

from dataclasses import dataclass
from math import isnan, nan

from fieldnav.messages import Bound, Evidence, Image
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.lane import LaneFit
from fieldnav.perception.perceive import find
from fieldnav.perception.sidestep.next_lane import NextLane, rows_beside
from fieldnav.perception.sidestep.passing_rows import Crossing, look_at_m
from fieldnav.perception.sidestep.row_words import LEAST_SHOWN
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from states.judgement import holds, second_opinion

OFF_PLACE = 0.3
"""Of the row spacing: a fresh look finds the lane this near to where the passing rows have it."""
OFF_SPACING = 0.2
"""Of the row spacing, as a fresh look finds it: uneven rows are within a tenth."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether the lane is as expected, and what was seen against what was expected.

    objection: what speaks against it most, in words; empty where it fits.
    """

    fits: bool
    objection: str
    evidence: tuple[Evidence, ...]


def verdict(
    image: Image, rows: Crossing, there: NextLane | None, crop: CropProfile, camera: Pinhole
) -> Verdict:
    """Hold a frame, looked at as if nothing were known, against the lane that the passing rows made."""
    found = find(image, crop, camera)
    fit = found.lane
    wanted = there.rows_seen if there else crop.rows.per_lane
    off_m = abs(_off_m(fit, rows, there, look_at_m(canopy_plane(camera, crop))))
    most_m, uneven = OFF_PLACE * crop.rows.spacing_m, _uneven(fit, crop)
    beside = rows_beside(rows, there, crop) if there else 0
    shown = sum(rows.rows[row].shown > LEAST_SHOWN for row in there.rows if row >= 0) if there else 0
    alike = fit is not None and (isnan(uneven) or uneven <= OFF_SPACING) and off_m <= most_m
    # Few plants at ragged ends may be too few for a fresh look; then those that are seen must be in place.
    seen = (alike and fit is not None and fit.rows_seen >= wanted) or (
        (fit is None or alike) and there is not None and shown >= wanted
    )
    fits = seen and not beside
    evidence = (
        Evidence("frame shows the lane as expected", float(fits), 1),
        Evidence("rows that a fresh look shows", fit.rows_seen if fit else 0, wanted, "rows"),
        Evidence("rows that show plants where they should", shown, wanted, "rows"),
        Evidence("its lane lies off by", off_m, most_m, "m", bound=Bound.AT_MOST),
        Evidence("its row spacing is off by the share", uneven, OFF_SPACING, bound=Bound.AT_MOST),
        Evidence("rows where the wheels will go", beside, 0, "rows", bound=Bound.AT_MOST),
    )
    return Verdict(fits, "" if fits else _objection(evidence), (*evidence, *second_opinion(found)))


def _objection(evidence: tuple[Evidence, ...]) -> str:
    """The gravest of what does not hold: what would be run over, where the lane lies, then what lacks."""
    _, _, shown, off, uneven, beside = evidence
    if not holds(beside):
        rows = "a row stands" if beside.value == 1 else f"{beside.value:.0f} rows stand"
        return f"{rows} where the wheels will go"
    known = (each for each in (off, uneven) if not isnan(each.value))  # nothing speaks against the unknown
    wrong = next((each for each in known if not holds(each)), None)
    if wrong is None:
        return f"{shown.value:.0f} of {shown.threshold:.0f} rows show plants where they should"
    return f"{wrong.name} {wrong.value:.2f} {wrong.unit}".strip() + f", at most {wrong.threshold:.2f}"


def _uneven(fit: LaneFit | None, crop: CropProfile) -> float:
    """How far the row spacing is off the profile's, as a share of it; NaN where it is not known."""
    return abs(fit.spacing_m / crop.rows.spacing_m - 1) if fit else nan


def _off_m(fit: LaneFit | None, rows: Crossing, there: NextLane | None, about_m: float) -> float:
    """How far outward the fresh look has the lane from where the passing rows have it."""
    if fit is None or there is None:
        return nan
    return rows.outward * (fit.offset_m + fit.slope * about_m) - there.middle_m
