"""All finders behind their one interface: the same rows, each in its own way."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.perception.perceive import find
from fieldnav.settings.crop import CropProfile, Finding, RowFinder


def by(crop: CropProfile, method: RowFinder) -> CropProfile:
    return crop.model_copy(update={"finding": Finding(method=method)})


@pytest.mark.parametrize("method", RowFinder)
@pytest.mark.parametrize("slope", [-0.05, 0.0, 0.05])
def test_every_method_finds_the_rows_of_the_lane(
    drawn: SimpleNamespace, method: RowFinder, slope: float
) -> None:
    crop = by(drawn.beet, method)
    image = drawn.picture(crop, drawn.camera, drawn.stand(crop, 0.03, slope, 0.01))

    view = find(image, crop, drawn.camera)

    assert view.lane
    for row, true in zip(view.lane.rows, drawn.rows(crop, drawn.camera, 0.03, slope), strict=True):
        assert row.x_bottom_px == pytest.approx(true.x_bottom_px, abs=15)
        assert row.x_top_px == pytest.approx(true.x_top_px, abs=15)
    assert view.paths_px.shape[0] == len(view.lines)


@pytest.mark.parametrize("method", RowFinder)
def test_no_method_believes_in_weeds(drawn: SimpleNamespace, method: RowFinder) -> None:
    crop = by(drawn.beet, method)
    for seed in range(4):
        image = drawn.picture(crop, drawn.camera, drawn.strewn(0, seed), drawn.strewn(25, seed), 0.025)
        assert find(image, crop, drawn.camera).lane is None


@pytest.mark.parametrize("method", RowFinder)
@pytest.mark.parametrize("level", [0, 128, 255])
def test_no_method_finds_rows_where_nothing_is(drawn: SimpleNamespace, method: RowFinder, level: int) -> None:
    view = find(np.full((720, 1280, 3), level, np.uint8), by(drawn.beet, method), drawn.camera)

    assert view.lane is None and not view.lines


def test_a_camera_whose_pose_is_not_trusted_is_searched_for_more_widely(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(5, 0.25)
    low = drawn.pinhole()
    image = drawn.picture(crop, low, drawn.stand(crop, 0.02))
    high = type(low)(low.width_px, low.height_px, low.focal_px, 1.7, low.tilt_rad, low.forward_m)

    assert len(find(image, crop, high, pose_known=False).lines) >= 4
    assert find(image, crop, high).lane is None
