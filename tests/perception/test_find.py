"""Rows of a fresh frame: exact on drawn pictures, none where there are none, mirrored when mirrored."""

from math import atan2, degrees
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.messages import RowLine
from fieldnav.perception.moving_variance import field_structure, find_rows
from fieldnav.perception.perceive import View, find
from fieldnav.perception.plants import find_plants

NOBODY = np.empty((0, 2))


def angle_deg(row: RowLine, height_px: int) -> float:
    return degrees(atan2(row.x_top_px - row.x_bottom_px, height_px - 1))


def assert_shows(view: View, truth: list[RowLine], width_px: int, height_px: int) -> None:
    """Every row within 1 % of the width at the bottom edge and within 1 degree."""
    assert view.lane is not None
    assert len(view.lane.rows) == len(truth)
    for row, true in zip(view.lane.rows, truth, strict=True):
        assert abs(row.x_bottom_px - true.x_bottom_px) < 0.01 * width_px
        assert abs(angle_deg(row, height_px) - angle_deg(true, height_px)) < 1


@settings(deadline=None, max_examples=15)
@given(st.floats(-0.08, 0.08), st.floats(-0.08, 0.08), st.sampled_from([(3, 0.35), (2, 0.55), (1, 0.75)]))
def test_rows_are_found_where_they_were_drawn(
    drawn: SimpleNamespace, at_near_m: float, slope: float, pattern: tuple[int, float]
) -> None:
    crop, camera = drawn.profile(*pattern), drawn.camera
    offset_m = at_near_m - slope * camera.view_m[0]
    image = drawn.picture(crop, camera, drawn.stand(crop, offset_m, slope))

    view = find(image, crop, camera)

    assert_shows(view, drawn.rows(crop, camera, offset_m, slope), 1280, 720)
    assert view.lane is not None
    assert view.lane.rows_seen == crop.rows.per_lane
    assert view.lane.offset_m == pytest.approx(offset_m, abs=0.01)
    assert view.lane.slope == pytest.approx(slope, abs=0.01)


@pytest.mark.parametrize("width_px", [320, 640, 1000, 1920])
def test_parameters_scale_with_the_picture(drawn: SimpleNamespace, width_px: int) -> None:
    crop, camera = drawn.beet, drawn.pinhole(width_px)

    view = find(drawn.picture(crop, camera, drawn.stand(crop, 0.03, 0.05)), crop, camera)

    assert_shows(view, drawn.rows(crop, camera, 0.03, 0.05), camera.width_px, camera.height_px)


@settings(deadline=None, max_examples=5)
@given(st.integers(0, 10_000))
def test_a_mirrored_picture_has_the_mirrored_rows(drawn: SimpleNamespace, seed: int) -> None:
    crop, camera = drawn.beet, drawn.camera
    plants = drawn.stand(crop, 0.04, -0.03, scatter_m=0.015, seed=seed)
    image = drawn.picture(crop, camera, plants, drawn.strewn(12, seed), seed=seed)

    plain = find(image, crop, camera)
    mirrored = find(np.ascontiguousarray(image[:, ::-1]), crop, camera)

    assert plain.lane is not None and mirrored.lane is not None
    assert mirrored.lane.offset_m == pytest.approx(-plain.lane.offset_m, abs=1e-6)
    assert mirrored.lane.slope == pytest.approx(-plain.lane.slope, abs=1e-6)
    flipped = [1279 - row.x_bottom_px for row in reversed(mirrored.lines)]
    assert [row.x_bottom_px for row in plain.lines] == pytest.approx(flipped, abs=1e-3)


@pytest.mark.parametrize("seed", range(6))
def test_weeds_between_the_rows_do_not_move_them(drawn: SimpleNamespace, seed: int) -> None:
    crop, camera = drawn.beet, drawn.camera
    image = drawn.picture(crop, camera, drawn.stand(crop, 0.02, 0.02), drawn.strewn(40, seed))

    view = find(image, crop, camera)

    assert view.lane is not None
    assert view.lane.rows_seen == 3
    assert view.lane.offset_m == pytest.approx(0.02, abs=0.02)


@pytest.mark.parametrize("missing", [0, 1, 2])
def test_a_missing_row_is_filled_in_at_its_place(drawn: SimpleNamespace, missing: int) -> None:
    crop, camera = drawn.beet, drawn.camera
    image = drawn.picture(crop, camera, drawn.stand(crop, -0.03, 0.04, without=(missing,)))

    view = find(image, crop, camera)

    assert_shows(view, drawn.rows(crop, camera, -0.03, 0.04), 1280, 720)
    assert view.lane is not None
    assert view.lane.rows_seen == 2
    assert [row.confidence == 0 for row in view.lane.rows] == [row == missing for row in range(3)]


def test_the_lane_is_found_at_its_beginning_when_only_the_far_half_holds_plants(
    drawn: SimpleNamespace,
) -> None:
    crop, camera = drawn.beet, drawn.camera
    plants = drawn.stand(crop, 0.03, 0.02, scatter_m=0.005, ahead_m=(1.2, 2.2))

    view = find(drawn.picture(crop, camera, plants), crop, camera)

    assert view.lane is not None
    assert view.lane.offset_m + 1.3 * view.lane.slope == pytest.approx(0.03 + 1.3 * 0.02, abs=0.01)


def test_the_neighbouring_lane_is_never_taken(drawn: SimpleNamespace) -> None:
    crop, camera = drawn.beet, drawn.camera
    beside = drawn.stand(crop, offset_m=-1.15)

    view = find(drawn.picture(crop, camera, beside), crop, camera)

    assert view.lane is None


def test_a_wider_bound_finds_a_lane_further_off(drawn: SimpleNamespace) -> None:
    crop, camera = drawn.profile(2, 0.3), drawn.camera
    image = drawn.picture(crop, camera, drawn.stand(crop, offset_m=0.25))

    bounded = find(image, crop, camera).lane
    wider = find(image, crop, camera, widest_offset_m=0.4).lane

    assert bounded is None or abs(bounded.offset_m + 0.8 * bounded.slope) < 0.16
    assert wider is not None
    assert wider.offset_m == pytest.approx(0.25, abs=0.01)


@pytest.mark.parametrize("seed", range(10))
def test_weeds_alone_are_no_lane(drawn: SimpleNamespace, seed: int) -> None:
    weeds = drawn.strewn(5 + 6 * seed, seed)
    image = drawn.picture(drawn.beet, drawn.camera, NOBODY, weeds, seed=seed)

    assert find(image, drawn.beet, drawn.camera).lane is None


@pytest.mark.parametrize(
    "colour", [(72, 96, 122), (0, 0, 0), (255, 255, 255), (40, 160, 60), (235, 190, 140)]
)
def test_a_picture_of_one_colour_has_no_lane(drawn: SimpleNamespace, colour: tuple[int, int, int]) -> None:
    image = np.full((720, 1280, 3), colour, np.uint8)

    assert find(image, drawn.beet, drawn.camera).lane is None


@pytest.mark.parametrize("brightest", [12, 256])
def test_noise_has_no_rows(drawn: SimpleNamespace, brightest: int) -> None:
    image = np.random.default_rng(1).integers(0, brightest, (720, 1280, 3), dtype=np.uint8)

    view = find(image, drawn.beet, drawn.camera)

    assert view.lane is None
    assert view.lines == ()


@pytest.mark.parametrize("shape", [(1, 1, 3), (720, 1280), (7, 1280, 3)])
def test_what_is_no_picture_has_no_rows(drawn: SimpleNamespace, shape: tuple[int, ...]) -> None:
    view = find(np.zeros(shape, np.uint8), drawn.beet, drawn.camera)

    assert (len(view.centres), view.lines, view.lane) == (0, (), None)


def test_the_field_structure_has_a_trough_on_every_row_and_peaks_between(drawn: SimpleNamespace) -> None:
    crop, camera = drawn.beet, drawn.camera
    image = drawn.picture(crop, camera, drawn.stand(crop, scatter_m=0.01))
    centres = find_plants(image, crop.vegetation, camera)

    structure = field_structure(centres, crop.finding, camera)
    rows = find_rows(centres, crop.finding, camera)

    places = structure.intersection_px[structure.troughs]
    for row, true in zip(rows, drawn.rows(crop, camera), strict=True):
        assert row.x_bottom_px == pytest.approx(true.x_bottom_px, abs=40)
        assert np.abs(places - true.x_bottom_px).min() < 60
    assert len(structure.peaks) >= 2
