"""Rows, and the camera itself, from a picture that nothing is known of."""

from dataclasses import replace
from math import degrees, radians
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.perception.unposed import FOCAL, find_unposed
from fieldnav.settings.crop import Finding, RowFinder


def field(drawn: SimpleNamespace, camera: object, slope: float = 0.0, seed: int = 1) -> np.ndarray:
    """A picture of seven rows at 0.35 m."""
    crop = drawn.profile(7, 0.35)
    places = drawn.stand(crop, 0.04, slope, 0.01, (0.3, 4.0), seed=seed)
    return np.asarray(drawn.picture(crop, camera, places, seed=seed))


@settings(deadline=None, max_examples=10)
@given(st.floats(58, 72), st.floats(-0.06, 0.06), st.booleans())
def test_tilt_and_height_follow_from_the_rows(
    drawn: SimpleNamespace, tilt_deg: float, slope: float, known: bool
) -> None:
    camera = replace(drawn.camera, focal_px=FOCAL * 1280, tilt_rad=radians(tilt_deg))

    seen = find_unposed(field(drawn, camera, slope), drawn.beet if known else None)

    assert seen.camera
    assert degrees(seen.camera.tilt_rad) == pytest.approx(tilt_deg, abs=5)
    if known:
        assert seen.camera.height_m == pytest.approx(camera.height_m - 0.04, rel=0.12)


def test_every_row_is_found_where_it_was_drawn(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(7, 0.35)

    view = find_unposed(field(drawn, drawn.camera), None).view

    true = [row for row in drawn.rows(crop, drawn.camera, 0.04) if 0 < row.x_bottom_px < 1279]
    assert len(view.lines) >= len(true)
    for row in true:
        off = min(
            abs(line.x_bottom_px - row.x_bottom_px) + abs(line.x_top_px - row.x_top_px) for line in view.lines
        )
        assert off < 0.02 * 1280


def test_curves_run_from_the_upper_edge_to_the_lower(drawn: SimpleNamespace) -> None:
    view = find_unposed(field(drawn, drawn.camera), None).view

    assert view.paths_px.shape[0] == len(view.lines)
    assert view.paths_px[:, 0, 1] == pytest.approx(0)
    assert view.paths_px[:, -1, 1] == pytest.approx(719)
    for path, line in zip(view.paths_px, view.lines, strict=True):
        assert path[[0, -1], 0] == pytest.approx([line.x_top_px, line.x_bottom_px], abs=5)


def test_a_mirrored_picture_has_the_mirrored_rows(drawn: SimpleNamespace) -> None:
    image = field(drawn, drawn.camera, 0.04)

    plain = find_unposed(image, None).view.lines
    mirrored = find_unposed(np.ascontiguousarray(image[:, ::-1]), None).view.lines

    assert len(plain) == len(mirrored)
    for one, other in zip(plain, reversed(mirrored), strict=True):
        assert one.x_bottom_px == pytest.approx(1279 - other.x_bottom_px, abs=4)
        assert one.x_top_px == pytest.approx(1279 - other.x_top_px, abs=4)


def test_bare_soil_tells_nothing_of_the_camera(drawn: SimpleNamespace) -> None:
    soil = np.full((720, 1280, 3), drawn.soil, np.uint8)

    seen = find_unposed(soil, None)

    assert seen.camera is None
    assert seen.view.lines == ()


def test_the_papers_finder_works_with_the_camera_found(drawn: SimpleNamespace) -> None:
    papers = drawn.beet.model_copy(update={"finding": Finding(method=RowFinder.MOVING_VARIANCE)})

    image = field(drawn, drawn.camera)
    by_comb, by_variance = (find_unposed(image, crop).view.lines for crop in (drawn.beet, papers))

    assert by_variance
    assert by_variance != by_comb
