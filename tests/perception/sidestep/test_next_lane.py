"""The next lane found among the rows that pass, whatever is missing, uneven or in the way."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.perception.sidestep.lane_odds import Expected
from fieldnav.perception.sidestep.next_lane import NextLane, next_lane, rows_beside
from fieldnav.perception.sidestep.passing_rows import Crossing
from fieldnav.settings.crop import CropProfile

DRILLED, UNKNOWN = Expected(1.5, 0.1, 2.5), Expected(None, 0.1, 2.5)
PATTERNS = pytest.mark.parametrize(
    ("rows", "spacing_m"), [(3, 0.35), (2, 0.55), (4, 0.25), (2, 0.75), (1, 0.5)]
)
SEEDS = pytest.mark.parametrize("seed", [1, *(pytest.param(seed, marks=pytest.mark.long) for seed in (2, 3))])
LIKELY = 0.9


def profile(drawn: SimpleNamespace, rows: int = 3, spacing_m: float = 0.35) -> CropProfile:
    crop: CropProfile = drawn.profile(per_lane=rows, spacing_m=spacing_m)
    return crop


def sure(crossing: Crossing, crop: CropProfile, expected: Expected = UNKNOWN) -> NextLane:
    lane = next_lane(crossing, expected, crop)
    assert lane and lane.probability >= LIKELY
    return lane


@pytest.mark.parametrize("outward", [1, -1], ids=["to the left", "to the right"])
@PATTERNS
def test_a_whole_lane_is_found_before_the_robot_stands_over_it(
    drawn: SimpleNamespace, stepping: SimpleNamespace, outward: int, rows: int, spacing_m: float
) -> None:
    crop = profile(drawn, rows, spacing_m)
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 1, 2)), outward)

    lane = sure(walk.end(stepping.pitch_m - 0.1), crop)

    assert lane.rows_seen == rows
    assert lane.middle_m == pytest.approx(0.1, abs=0.03)
    assert lane.pitch_m == pytest.approx(stepping.pitch_m, abs=0.04)


def test_a_mirrored_field_gives_the_same_lane(drawn: SimpleNamespace, stepping: SimpleNamespace) -> None:
    crop, field = profile(drawn), stepping.lanes(profile(drawn), (0, 1))

    left, right = (stepping.Walk(crop, drawn.camera, field, outward).end(1.3) for outward in (1, -1))

    assert sure(left, crop).middle_m == pytest.approx(sure(right, crop).middle_m, abs=1e-6)
    assert left.slope == pytest.approx(-right.slope, abs=1e-6)


@pytest.mark.parametrize(("rows", "spacing_m"), [(3, 0.35), (2, 0.55), (2, 0.75), (4, 0.25)])
@SEEDS
def test_a_lane_with_a_row_less_is_taken_where_the_drill_put_it(
    drawn: SimpleNamespace, stepping: SimpleNamespace, rows: int, spacing_m: float, seed: int
) -> None:
    crop = profile(drawn, rows, spacing_m)
    for missing in range(rows):
        field = stepping.lanes(crop, (0, 1, 2), without=[(1, missing)], seed=seed)

        lane = sure(stepping.Walk(crop, drawn.camera, field).end(stepping.pitch_m), crop, DRILLED)

        assert lane.rows_seen == rows - 1 and lane.rows[missing] == -1
        assert lane.middle_m == pytest.approx(0.0, abs=0.03)


def test_a_row_missing_in_the_middle_shows_itself_without_knowing_the_drill(
    drawn: SimpleNamespace, stepping: SimpleNamespace
) -> None:
    crop = profile(drawn)
    field = stepping.lanes(crop, (0, 1, 2), without=[(1, 1)])

    lane = sure(stepping.Walk(crop, drawn.camera, field).end(stepping.pitch_m + 0.15), crop, UNKNOWN)

    assert lane.rows_seen == 2 and lane.middle_m == pytest.approx(-0.15, abs=0.03)


def test_an_outer_row_missing_leaves_a_doubt_where_the_drill_is_not_known(
    drawn: SimpleNamespace, stepping: SimpleNamespace
) -> None:
    crop = profile(drawn)
    field = stepping.lanes(crop, (0, 1), without=[(1, 0)])

    lane = next_lane(stepping.Walk(crop, drawn.camera, field).end(stepping.pitch_m), UNKNOWN, crop)

    assert lane is None or lane.probability < LIKELY


@pytest.mark.parametrize("drilled_m", [1.35, 1.65], ids=["15 cm near", "15 cm far"])
def test_a_lane_15_cm_off_the_drill_is_still_the_lane(
    drawn: SimpleNamespace, stepping: SimpleNamespace, drilled_m: float
) -> None:
    crop = profile(drawn)
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 1, 2)))

    lane = sure(walk.end(stepping.pitch_m), crop, Expected(drilled_m, 0.1, 2.5))

    assert lane.rows_seen == 3 and lane.middle_m == pytest.approx(0.0, abs=0.03)


@PATTERNS
@SEEDS
def test_uneven_row_distances_are_borne(
    drawn: SimpleNamespace, stepping: SimpleNamespace, rows: int, spacing_m: float, seed: int
) -> None:
    crop = profile(drawn, rows, spacing_m)
    field = stepping.lanes(crop, (0, 1, 2), uneven=0.1, seed=seed)

    lane = sure(stepping.Walk(crop, drawn.camera, field).end(stepping.pitch_m), crop)

    assert lane.rows_seen == rows and lane.middle_m == pytest.approx(0.0, abs=0.03)


def test_weeds_in_a_line_between_the_lanes_are_no_row_of_the_lane(
    drawn: SimpleNamespace, stepping: SimpleNamespace
) -> None:
    crop = profile(drawn)
    weeds = np.array([[x, 0.68 + 0.005 * step] for step, x in enumerate(np.arange(1.2, 1.9, 0.15))])
    field = np.concatenate([stepping.lanes(crop, (0, 1)), weeds])
    walk = stepping.Walk(crop, drawn.camera, field)

    lane = sure(walk.end(stepping.pitch_m), crop)

    assert lane.rows_seen == 3 and lane.middle_m == pytest.approx(0.0, abs=0.03)


def test_a_lane_missing_altogether_is_not_made_up(drawn: SimpleNamespace, stepping: SimpleNamespace) -> None:
    crop = profile(drawn)
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0,)))

    assert all(
        next_lane(crossing, UNKNOWN, crop) is None for _, crossing in walk.steps(np.arange(0, 2.5, 0.01))
    )


def test_the_lane_after_a_missing_one_is_told_by_its_distance(
    drawn: SimpleNamespace, stepping: SimpleNamespace
) -> None:
    crop = profile(drawn)
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 2)))

    lane = next_lane(walk.end(2.9), Expected(1.5, 0.1, 3.5), crop)

    assert lane and lane.pitch_m == pytest.approx(2 * stepping.pitch_m, abs=0.08)


@pytest.mark.parametrize("expected", [UNKNOWN, DRILLED], ids=["unknown", "drilled"])
def test_rows_that_go_on_evenly_are_no_lane_where_none_can_be(
    drawn: SimpleNamespace, stepping: SimpleNamespace, expected: Expected
) -> None:
    crop = profile(drawn, 2, 0.75)
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 1, 2), without=[(1, 0)]))

    lane = next_lane(walk.end(2.2), expected, crop)

    off_m, most_m = expected.off_m(lane.pitch_m, crop) if lane else (0.0, 0.0)
    assert lane is None or lane.pitch_m < 1.8 or off_m > most_m


def test_rows_where_the_wheels_will_go_are_noticed(drawn: SimpleNamespace, stepping: SimpleNamespace) -> None:
    crop = profile(drawn)
    walk = stepping.Walk(crop, drawn.camera, stepping.lanes(crop, (0, 1, 2)))
    crossing = walk.end(stepping.pitch_m)
    lane = sure(crossing, crop)
    shifted = replace(lane, middle_m=lane.middle_m + crop.rows.spacing_m)

    assert rows_beside(crossing, lane, crop) == 0
    assert rows_beside(crossing, shifted, crop) == 1
