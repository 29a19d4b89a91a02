"""A camera that looks at the horizon, or nearly: the ground that counts ends below it."""

from math import atan, degrees, radians, tan

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.messages import Image, RowLine, Side
from fieldnav.perception.canopy import MIN_SPACING_PX, canopy_plane
from fieldnav.perception.ground_plants import FAR_M, on_ground
from fieldnav.perception.ground_view import GroundView
from fieldnav.perception.perceive import find
from fieldnav.perception.plants import find_plants
from fieldnav.perception.sidestep.passing_rows import LENGTH_M, usual_length_m
from fieldnav.perception.vegetation import vegetation_of
from fieldnav.pinhole import Pinhole
from fieldnav.settings.camera import FURTHEST_DEG, FURTHEST_M
from fieldnav.settings.crop import RowFinder
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.plan import sow
from fieldnav.simulation.rendering.view import View
from fieldnav.simulation.shaking import Attitude, rotation
from fieldnav.simulation.sketch import SketchRenderer

CROP = load_crop("sugar-beet")
OBLIQUE_DEG = (10, 15, 20, 25)
TREES_BGR = (40, 200, 60)  # greener than any crop
OFFSET_M, SLOPE = 0.06, 0.04
NEAR_M, NEAR_SLOPE = 0.03, 0.02
ENDLESS_M = 20.0


def camera(tilt_deg: float, width_px: int = 640, **changes: float) -> Pinhole:
    given = {"width_px": width_px, "height_px": width_px * 9 // 16, "tilt_deg": tilt_deg} | changes
    return revised(load_robot("bonnbot").cameras.front, given).pinhole()


def lane(seen: Pinhole, offset_m: float = OFFSET_M, slope: float = SLOPE) -> Image:
    """A lane without weeds, whose middle lies so from the robot: y = offset + slope x in its coordinates."""
    field = revised(load_field("demo"), {"lanes": 1, "length_m": ENDLESS_M, "weeds": {"per_m2": 0}})
    plan = sow(field, CROP, Side.RIGHT)
    turned = rotation(Attitude(), 1, -atan(slope), seen.tilt_rad)
    place = np.array([5.0, float(plan.rows.lane_n(0, 5.0)) - offset_m, seen.height_m])
    reach_m = max(4.5, 2 * seen.view_m[1])
    view = View(seen.width_px, seen.height_px, seen.focal_px, place, turned, reach_m)
    return SketchRenderer(plan, field, CROP).render(view, 0.0)


def with_trees(image: Image, seen: Pinhole) -> Image:
    """All of it that looks above the horizon is green."""
    wooded = image.copy()
    wooded[: int(seen.sky_px)] = TREES_BGR
    return wooded


@pytest.mark.parametrize("tilt_deg", [32, 45, 65, 90])
def test_a_camera_that_looks_at_ground_alone_uses_all_of_its_image(tilt_deg: float) -> None:
    seen = camera(tilt_deg)

    assert seen.top_px == canopy_plane(seen, CROP).top_px == 0
    assert seen.ground_middle_px == seen.centre_y_px and seen.sky_px == 0
    assert GroundView(seen).oblique == (tilt_deg < 52)


@pytest.mark.parametrize("tilt_deg", [*OBLIQUE_DEG, 30])
def test_ground_counts_up_to_ten_degrees_below_the_horizon(tilt_deg: float) -> None:
    seen = camera(tilt_deg)

    ahead_m = seen.view_m[1] - seen.forward_m
    assert degrees(atan(seen.height_m / ahead_m)) == pytest.approx(FURTHEST_DEG)
    assert seen.horizon_px < seen.top_px <= seen.centre_y_px


@pytest.mark.parametrize(("tilt_deg", "length_m"), [(90, LENGTH_M), (65, LENGTH_M), (45, 0.9), (30, 2.4)])
def test_the_flatter_a_camera_looks_the_more_of_a_row_is_in_view(tilt_deg: float, length_m: float) -> None:
    assert usual_length_m(camera(tilt_deg)) == pytest.approx(length_m, abs=0.1)


def test_ground_of_a_high_camera_counts_up_to_eight_metres_but_half_the_image_does_in_any_case() -> None:
    high, flat = camera(20, height_m=2.0), camera(10, height_m=5.0)

    assert high.view_m[1] - high.forward_m == pytest.approx(FURTHEST_M)
    assert flat.top_px == pytest.approx(flat.centre_y_px)


def test_rows_that_a_few_pixels_hold_do_not_count() -> None:
    small = camera(15, 96)
    plane = canopy_plane(small, CROP)

    assert small.top_px < plane.top_px < small.height_px - 1
    assert CROP.rows.spacing_m * float(plane.pixels_per_metre(plane.top_px)) == pytest.approx(MIN_SPACING_PX)
    assert canopy_plane(camera(15, 86), CROP).top_px <= camera(15, 86).ground_middle_px


@given(tilt_deg=st.sampled_from(OBLIQUE_DEG), offset_m=st.floats(-1, 1), slope=st.floats(-0.25, 0.25))
def test_a_row_of_the_ground_is_a_line_of_the_image_and_back(
    tilt_deg: float, offset_m: float, slope: float
) -> None:
    seen = camera(tilt_deg)

    row = seen.row_in_image(offset_m, slope)

    assert seen.row_on_ground(row) == pytest.approx((offset_m, slope), abs=1e-9)
    near, far = seen.to_image(np.array([[x, offset_m + slope * x] for x in seen.view_m]))
    last = seen.height_px - 1.0
    assert row.at(near[1], last) == pytest.approx(near[0]) and row.at(far[1], last) == pytest.approx(far[0])


def test_parallel_rows_meet_on_the_horizon() -> None:
    seen = camera(15)
    rows = [seen.row_in_image(offset_m, 0.1) for offset_m in (-0.35, 0.0, 0.35)]

    places = [row.at(seen.horizon_px, seen.height_px - 1.0) for row in rows]

    assert np.ptp(places) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("width_px", [640, 1280])
def test_trees_above_the_horizon_have_no_part_in_the_threshold(width_px: int) -> None:
    seen = camera(15, width_px)
    image = lane(seen)

    plain, wooded = (
        vegetation_of(each, CROP.vegetation, seen.top_px) for each in (image, with_trees(image, seen))
    )

    assert plain.threshold == wooded.threshold
    assert np.array_equal(plain.mask, wooded.mask) and np.array_equal(plain.strength, wooded.strength)
    scale = seen.height_px / len(plain.index)
    assert plain.top * scale == pytest.approx(seen.top_px, abs=1.5 * scale)
    assert not plain.mask[: plain.top].any() and not plain.strength[: plain.top].any()
    assert plain.mask.any()


@pytest.mark.parametrize("tilt_deg", OBLIQUE_DEG)
def test_no_plants_are_taken_from_above_the_ground_that_counts(tilt_deg: float) -> None:
    seen = camera(tilt_deg)

    plants = find_plants(with_trees(lane(seen), seen), CROP.vegetation, seen)

    assert len(plants) and plants.position_px[:, 1].min() >= seen.top_px - 1


def test_a_canopy_closed_over_the_ground_hides_its_plants_under_any_sky() -> None:
    seen = camera(10)
    image = np.full((seen.height_px, seen.width_px, 3), (230, 222, 210), np.uint8)
    image[int(seen.top_px) :] = (46, 124, 74)

    assert not len(find_plants(image, CROP.vegetation, seen))


def test_plants_where_rows_cannot_be_told_apart_are_far_off() -> None:
    small = camera(15, 96)
    between_px = (small.top_px + canopy_plane(small, CROP).top_px) / 2
    plants = find_plants(lane(camera(15)), CROP.vegetation, camera(15))
    moved = type(plants)(np.array([[48.0, between_px]]), *(np.ones(1) for _ in range(3)))

    assert (on_ground(moved, CROP, small).position_m == FAR_M).all()


@pytest.mark.parametrize("method", list(RowFinder))
@pytest.mark.parametrize("tilt_deg", OBLIQUE_DEG)
def test_the_lane_is_found_below_a_wooded_horizon(tilt_deg: float, method: RowFinder) -> None:
    seen = camera(tilt_deg)
    crop = CROP.model_copy(update={"finding": CROP.finding.model_copy(update={"method": method})})

    found = find(with_trees(lane(seen), seen), crop, seen)

    assert found.lane is not None and found.lane.rows_seen == CROP.rows.per_lane
    assert found.lane.offset_m == pytest.approx(OFFSET_M, abs=NEAR_M)
    assert found.lane.slope == pytest.approx(SLOPE, abs=NEAR_SLOPE)
    for line, path in zip(found.lines, found.paths_px, strict=True):
        assert path[0, 1] == pytest.approx(seen.top_px, abs=2) and path[-1, 1] == seen.height_px - 1
        on_line = [line.at(y, seen.height_px - 1.0) for y in path[:, 1]]
        assert np.abs(path[:, 0] - on_line).max() < CROP.rows.spacing_m / 2 * float(
            seen.pixels_per_metre(seen.centre_y_px)
        )


def test_a_mirrored_image_gives_the_negated_offset() -> None:
    seen = camera(15)
    image = lane(seen)

    plain, mirrored = (find(each, CROP, seen).lane for each in (image, np.ascontiguousarray(image[:, ::-1])))

    assert plain is not None and mirrored is not None
    assert mirrored.offset_m == pytest.approx(-plain.offset_m, abs=0.01)
    assert mirrored.slope == pytest.approx(-plain.slope, abs=0.01)


def test_the_map_of_the_ground_is_near_and_knows_how_far_pitch_moves_it() -> None:
    seen = camera(15)
    view = GroundView(seen)
    ahead_m = view.middle_m - seen.forward_m

    moved_m = seen.height_m / tan(atan(seen.height_m / ahead_m) - radians(0.1)) - ahead_m

    assert view.middle_m - seen.view_m[0] == pytest.approx(0.5)
    assert moved_m == pytest.approx(view.shake_share * radians(0.1), rel=0.02)


def test_one_weed_at_the_edge_of_the_map_is_not_what_motion_is_told_by() -> None:
    view = GroundView(camera(15))
    soil = np.full((360, 640, 3), (72, 96, 122), np.uint8)
    soil += np.random.default_rng(1).integers(0, 2, soil.shape).astype(np.uint8)
    cv2.circle(soil, (20, 352), 14, (50, 150, 70), cv2.FILLED)

    ground = view.look(soil)

    assert ground.green.contrast > 1 and view.motion(ground, ground, 0.2) is None


def test_a_line_is_read_off_at_any_image_row() -> None:
    row = RowLine(100.0, 200.0)

    assert [row.at(y, 100.0) for y in (0.0, 50.0, 100.0)] == [100, 150, 200]
