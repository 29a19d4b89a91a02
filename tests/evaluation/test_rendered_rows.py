"""Rendered pictures with known rows: the truth follows the camera, the score what was found."""

from math import radians, tan

import numpy as np
import pytest

from fieldnav.evaluation.rendered_rows import field_figures, lane_found, score
from fieldnav.evaluation.rendered_scene import Place, Scene, Shot
from fieldnav.evaluation.rendered_truth import straight_line
from fieldnav.messages import RowLine, Side
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.perceive import find
from fieldnav.settings.crop import CropProfile, RowFinder
from fieldnav.settings.field import CameraErrors, FieldSettings, Gaps, Rows, Weeds
from fieldnav.settings.loading import load_crop, load_field
from fieldnav.simulation.plan import sow

STILL = CameraErrors(shake_deg=0, bounce_m=0, tilt_error_deg=0, height_error_m=0, focal_error=0)
TIDY = Rows(wander_m=0, pass_error_m=0, scatter_m=0, ragged_m=0)
TILT_RAD = radians(65)
BEET = load_crop("sugar-beet")


def scene_of(crop: CropProfile = BEET, **changes: object) -> Scene:
    settings: dict[str, object] = {
        "name": "plot",
        "crop": crop.name,
        "lanes": 1,
        "length_m": 12.0,
        "rows": TIDY,
        "gaps": Gaps(germination=1, row_gaps_per_10m=0),
        "weeds": Weeds(per_m2=0, headland_per_m2=0),
        "camera_errors": STILL,
    }
    field = FieldSettings.model_validate(settings | changes)
    return Scene(field, crop, sow(field, crop, Side.RIGHT))


def shoot(scene: Scene, place: Place, seed: int = 1) -> Shot:
    return scene.shoot(place, TILT_RAD, np.random.default_rng(seed))


def bottoms(shot: Shot) -> list[float]:
    return sorted(row.x_bottom_px for row in shot.truth)


@pytest.fixture(scope="module")
def tidy() -> Scene:
    return scene_of()


def test_the_true_rows_of_a_camera_without_errors_are_those_of_the_pinhole_over_the_canopy(
    tidy: Scene,
) -> None:
    plane = canopy_plane(tidy.camera, BEET)

    shot = shoot(tidy, Place(0, 6.0, offset_m=0.05))

    expected = [plane.row_in_image(place - 0.05, 0.0) for place in (-0.35, 0.0, 0.35)]
    for row, known in zip(shot.truth, expected, strict=True):
        assert row.x_bottom_px == pytest.approx(known.x_bottom_px, abs=0.1)
        assert row.x_top_px == pytest.approx(known.x_top_px, abs=0.1)


def test_a_robot_further_left_sees_the_rows_further_right(tidy: Scene) -> None:
    plane = canopy_plane(tidy.camera, BEET)
    a_metre_px = float(plane.pixels_per_metre(tidy.camera.height_px - 1.0))

    middle, left = (shoot(tidy, Place(0, 6.0, offset_m=offset)) for offset in (0.0, 0.08))

    assert np.subtract(bottoms(left), bottoms(middle)) == pytest.approx(0.08 * a_metre_px, abs=0.1)


def test_a_robot_turned_left_sees_the_rows_lean_to_the_right(tidy: Scene) -> None:
    shot = shoot(tidy, Place(0, 6.0, turn_rad=0.06))

    plane = canopy_plane(tidy.camera, BEET)
    slopes = [plane.row_on_ground(row)[1] for row in shot.truth]
    assert slopes == pytest.approx([-tan(0.06)] * 3, abs=1e-4)
    assert shot.truth[1].x_top_px > shot.truth[1].x_bottom_px


def test_against_the_lane_the_same_rows_are_seen_the_other_way_round(tidy: Scene) -> None:
    along = shoot(tidy, Place(0, 6.0, offset_m=0.04))
    against = shoot(tidy, Place(0, 6.0, offset_m=0.04, turn_rad=np.pi))

    last_px = tidy.camera.width_px - 1
    assert bottoms(against) == pytest.approx(sorted(last_px - x for x in bottoms(along)), abs=0.1)


def test_perception_is_told_the_drawn_tilt_while_the_truth_has_the_camera_s_own() -> None:
    wrong = scene_of(camera_errors=STILL.model_copy(update={"tilt_error_deg": 5.0}))

    shots = [shoot(wrong, Place(0, 6.0), seed) for seed in (1, 2)]

    assert [shot.camera.tilt_rad for shot in shots] == [TILT_RAD] * 2
    assert abs(shots[0].truth[0].x_top_px - shots[1].truth[0].x_top_px) > 5


def test_a_row_of_which_no_plant_shows_is_no_true_row() -> None:
    nothing_ahead = shoot(scene_of(), Place(0, 12.2))

    assert nothing_ahead.truth == ()


def test_random_places_lie_within_the_bounds_with_rows_all_over_the_view(tidy: Scene) -> None:
    random = np.random.default_rng(4)

    places = [tidy.random_place(random) for _ in range(200)]

    assert max(abs(place.offset_m) for place in places) == pytest.approx(0.1, abs=0.005)
    turns = [(place.turn_rad + 1) % np.pi - 1 for place in places]
    assert max(map(abs, turns)) == pytest.approx(radians(5), abs=0.005)
    assert all(3 <= place.s_m <= 9 for place in places)


def test_the_line_through_a_bend_leaves_as_much_on_either_side() -> None:
    y = np.arange(0.0, 101.0)

    line = straight_line(np.stack([y * y / 100, y], axis=-1), 101)

    on_line = line.x_top_px + (line.x_bottom_px - line.x_top_px) * y / 100
    assert float((y * y / 100 - on_line).mean()) == pytest.approx(0, abs=1e-6)
    assert line.x_bottom_px - line.x_top_px == pytest.approx(100, abs=0.5)


def test_a_perfect_finder_scores_all(tidy: Scene) -> None:
    shot = shoot(tidy, Place(0, 6.0))

    assert (score(shot.truth, reversed(shot.truth), shot.camera) == 100).all()


def test_a_row_off_by_a_tenth_of_the_width_scores_nine_tenths_and_keeps_its_angle(tidy: Scene) -> None:
    shot = shoot(tidy, Place(0, 6.0))
    aside = [RowLine(row.x_top_px + 128, row.x_bottom_px + 128) for row in shot.truth]

    assert score(shot.truth, aside, shot.camera) == pytest.approx(np.array([[90.0, 100, 100]] * 3))


@pytest.mark.parametrize(("off_deg", "wide", "narrow"), [(1.5, 100, 100), (5.0, 100, 0), (15.0, 0, 0)])
def test_a_row_turned_about_its_foot_loses_its_angle(
    tidy: Scene, off_deg: float, wide: float, narrow: float
) -> None:
    true = RowLine(640.0, 640.0)
    turned = RowLine(640.0 + 719 * tan(radians(off_deg)), 640.0)

    assert score([true], [turned], tidy.camera).tolist() == [[100, wide, narrow]]


def test_a_missed_row_scores_nothing_and_its_neighbour_does_not_stand_for_it(tidy: Scene) -> None:
    shot = shoot(tidy, Place(0, 6.0))

    scored = score(shot.truth, shot.truth[:2], shot.camera)

    assert sorted(scored[:, 0]) == [0, 100, 100]
    assert (score(shot.truth, [], shot.camera) == 0).all()


def test_the_rows_of_a_tidy_field_are_found(tidy: Scene) -> None:
    shot = shoot(tidy, Place(0, 6.0, offset_m=-0.06, turn_rad=0.04))

    scored = score(shot.truth, lane_found(shot, BEET), shot.camera)

    assert scored.shape == (3, 3)
    assert scored[:, 0].min() > 98
    assert (scored[:, 1] == 100).all()


def test_rows_too_few_for_a_lane_are_reported_as_the_finder_shows_them(tidy: Scene) -> None:
    shot = shoot(tidy, Place(0, 6.0))
    wide = BEET.model_copy(update={"rows": BEET.rows.model_copy(update={"per_lane": 7})})

    found = lane_found(shot, wide)

    assert find(shot.image, wide, shot.camera).lane is None
    assert score(shot.truth, found, shot.camera)[:, 0].min() > 98


def test_a_field_has_three_goals_by_its_profile_s_own_method_and_none_by_another() -> None:
    told: list[tuple[str, int, int]] = []

    figures = field_figures(load_field("sugar-beet"), 2, 5, lambda *part: told.append(part))

    asked = [figure for figure in figures if figure.goal is not None]
    assert [(figure.case, figure.goal) for figure in asked] == [("sugar-beet", g) for g in (98, 99.5, 95)]
    assert len(figures) == 3 * len(RowFinder)
    assert len({figure.case for figure in figures}) == len(RowFinder)
    assert told[-1] == ("sugar-beet", 2, 2)


def test_the_same_seed_gives_the_same_figures() -> None:
    one, again = (field_figures(load_field("coriander"), 1, 8, lambda *part: None) for _ in range(2))

    assert one == again
