"""The check of the crop profile against what a camera sees: rows, their distance, and their width."""

from collections.abc import Iterator

from fieldnav.messages import Frame
from fieldnav.perception.lane import LaneFit
from fieldnav.perception.perceive import find
from fieldnav.perception.second_witness import NO_FIELD, by_vegetation_alone
from fieldnav.pinhole import Pinhole
from fieldnav.preflight.finding import Concern, Finding, Verdict, finding_of
from fieldnav.preflight.row_measures import canopy_width_m, spacing_m
from fieldnav.settings.crop import CropProfile

DOUBTFUL, WRONG = 0.15, 0.3
"""Of the row spacing; our choice. In rendered fields a frame errs by up to 0.09 with the right profile, and
shows rows of the paper's other pattern 0.4 off. There too wide may be a gap or the way to the next lane, too
narrow was never seen with the right profile."""
OTHER_CANOPY = 0.4
"""Of the canopy width, our choice: another growth stage. In rendered fields a frame errs by up to 0.25."""
RIGHT_CROP = "name the crop that grows here, or set its profile right"
UNKNOWN_CROP = "if it does, the network does not know this crop: docs/faults.md, no field in view"
OVER_ROWS = "stand the robot over rows of this crop"
ON_THE_LANE = "stand it on the middle of a lane"


def row_findings(frame: Frame, crop: CropProfile, camera: Pinhole) -> Iterator[Finding]:
    """What the rows in a frame tell of the crop profile."""
    # Rows of quite another spacing are found too where the camera's height is taken for unknown.
    free = find(frame.image, by_vegetation_alone(crop), camera, pose_known=False)
    view = find(frame.image, crop, camera)
    apart_m = spacing_m(free, crop, camera)
    called = f"{frame.camera.value} camera"
    if view.no_field:
        yield Finding(f"{called} rows", Verdict.WARNING, NO_FIELD, f"{OVER_ROWS}; {UNKNOWN_CROP}")
        return
    if apart_m is None:
        figure = f"{len(free.lines)} seen; the profile has {crop.rows.per_lane} to a lane"
        verdict = Verdict.OK if len(free.lines) == crop.rows.per_lane else Verdict.WARNING
        yield Finding(f"{called} rows", verdict, figure, OVER_ROWS if verdict is not Verdict.OK else "")
        return
    rows = _rows(f"{called} rows", len(free.lines), apart_m, view.lane, crop)
    yield rows
    if rows.verdict is Verdict.OK:
        yield _canopy(f"{called} canopy", canopy_width_m(view, crop, camera), crop)


def _rows(check: str, count: int, apart_m: float, lane: LaneFit | None, crop: CropProfile) -> Finding:
    """Distance and number of the rows, each against the profile's."""
    profile, seen = crop.rows, lane.rows_seen if lane else 0
    if lane and seen == profile.per_lane and apart_m > lane.spacing_m:
        apart_m = lane.spacing_m  # what was found freely has left rows out
    apart = f"{count} seen {apart_m:.2f} m apart, {profile.spacing_m:g} m in the profile"
    under = f"{seen} of the lane's {profile.per_lane} rows under the robot"
    concerns = list(_distance(apart, apart_m / profile.spacing_m - 1))
    if seen < profile.per_lane:
        concerns.append(Concern(Verdict.WARNING, under, ON_THE_LANE))
    return finding_of(check, f"{apart}; {under}", concerns)


def _distance(apart: str, over: float) -> Iterator[Concern]:
    """over: how much wider the rows stand than in the profile, as a share of it."""
    if over < -WRONG:
        yield Concern(Verdict.FAIL, apart, f"{RIGHT_CROP}; or set the camera's height right")
    elif over < -DOUBTFUL:
        yield Concern(Verdict.WARNING, apart, RIGHT_CROP)
    elif over > DOUBTFUL:  # gaps look like that too, and the distance to the next lane
        yield Concern(Verdict.WARNING, apart, f"{ON_THE_LANE}; if it does, {RIGHT_CROP}")


def _canopy(check: str, width_m: float | None, crop: CropProfile) -> Finding:
    expected_m = crop.plants.canopy_width_m
    if width_m is None:
        figure = "its width cannot be told: too little green on the rows, or green all between them"
        return Finding(check, Verdict.WARNING, figure, RIGHT_CROP)
    figure = f"{width_m:.2f} m wide, {expected_m:g} m in the profile"
    if abs(width_m / expected_m - 1) <= OTHER_CANOPY:
        return Finding(check, Verdict.OK, figure)
    return Finding(check, Verdict.WARNING, figure, f"{RIGHT_CROP}: plants grow")
