"""Pictures without rows: what is in them, and what counts as reporting a row."""

import numpy as np
import pytest

from fieldnav.evaluation.rendered_scene import Place, Scene
from fieldnav.evaluation.rowless import KINDS, as_large, kind_figures, reports_row
from fieldnav.messages import Image, Side
from fieldnav.perception.perceive import find
from fieldnav.perception.vegetation import excess_green
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.plan import sow

CAMERA = load_robot("bonnbot").cameras.front.pinhole()
BEET = load_crop("sugar-beet")
GREEN_LEVEL = 40


def drawn(kind: str, seed: int = 1) -> Image:
    return KINDS[kind](np.random.default_rng(seed))


def green_share(kind: str) -> float:
    return float(np.mean([(excess_green(drawn(kind, seed)) > GREEN_LEVEL).mean() for seed in (1, 2)]))


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_a_colour_picture_and_the_same_for_the_same_seed(kind: str) -> None:
    picture = drawn(kind)

    assert picture.dtype == np.uint8
    assert picture.ndim == 3 and picture.shape[2] == 3
    assert (picture == drawn(kind)).all()


def test_no_crop_stands_on_bare_soil_and_weeds_grow_as_densely_as_they_are_called() -> None:
    shares = [green_share(kind) for kind in ("bare soil", "sparse small weeds", "dense large weeds")]

    assert shares[0] < 0.0005
    assert shares == sorted(shares)
    assert shares[2] > 0.02


def test_tyre_tracks_are_two_dark_bands_beside_the_middle() -> None:
    brightness = np.mean([drawn("tyre tracks", seed)[-40:].mean(axis=(0, 2)) for seed in range(3)], axis=0)

    left, middle, right = (brightness[part].mean() for part in np.split(np.arange(1260), 3))
    assert max(left, right) < middle


def test_a_picture_of_rows_reports_a_row_and_a_black_one_none() -> None:
    field = revised(load_field("demo"), {"length_m": 12.0})
    scene = Scene(field, BEET, sow(field, BEET, Side.RIGHT))
    shot = scene.shoot(Place(0, 6.0), CAMERA.tilt_rad, np.random.default_rng(1))

    assert reports_row(find(shot.image, BEET, CAMERA))
    assert not reports_row(find(np.zeros_like(shot.image), BEET, CAMERA))


@pytest.mark.parametrize(("height", "width"), [(720, 1280), (9, 9), (2000, 16), (48, 64)])
def test_a_picture_s_camera_has_its_size_and_sees_no_horizon(height: int, width: int) -> None:
    camera = as_large(CAMERA, np.zeros((height, width, 3), np.uint8))

    assert (camera.height_px, camera.width_px) == (height, width)
    assert np.isfinite(camera.view_m).all()
    if (height, width) == (720, 1280):
        assert camera == CAMERA


def test_a_kind_that_shows_nothing_is_right_every_time() -> None:
    told: list[tuple[str, int, int]] = []

    figures = kind_figures("white", 3, 1, lambda *part: told.append(part))

    assert [(figure.value, figure.met) for figure in figures] == [(1.0, True)] * 2
    assert told[-1] == (figures[0].case, 3, 3)
