"""The network's opinion of rows that vegetation shows: rows of a field are borne out, other green is not."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.evaluation.rowless import as_large
from fieldnav.messages import Image
from fieldnav.perception.perceive import find
from fieldnav.perception.second_witness import BORNE_OUT, by_vegetation_alone, share_borne_out
from fieldnav.settings.crop import CropProfile
from fieldnav.training.light import expose
from fieldnav.training.rowless import draw_leaves, draw_scene, draw_uprights

SEEDS = 20


@pytest.fixture(scope="module")
def beet(drawn: SimpleNamespace) -> CropProfile:
    return drawn.profile(3, 0.35)


@pytest.fixture(scope="module")
def rowless() -> list[Image]:
    pictures = []
    for seed in range(SEEDS):
        for scene in (draw_leaves, draw_uprights, draw_scene):
            random = np.random.default_rng(seed)
            pictures.append(expose(random, scene(random)))
    return pictures


def test_rows_of_a_field_are_borne_out(drawn: SimpleNamespace, beet: CropProfile) -> None:
    image = drawn.picture(beet, drawn.camera, drawn.stand(beet))

    view = find(image, beet, drawn.camera)

    assert view.lane is not None and not view.no_field
    assert view.borne_out == share_borne_out(image, view.lane.rows, beet, drawn.camera) > BORNE_OUT


def test_what_vegetation_takes_for_rows_in_scenes_is_no_field(
    rowless: list[Image], beet: CropProfile, drawn: SimpleNamespace
) -> None:
    camera = as_large(drawn.camera, rowless[0])
    by_vegetation = [find(image, by_vegetation_alone(beet), camera) for image in rowless]
    by_both = [find(image, beet, camera) for image in rowless]

    taken = [bool(view.lines) for view in by_vegetation]
    assert np.mean(taken) > 0.05
    left = [bool(view.lines) or view.lane is not None for view in by_both]
    assert np.mean(left) < np.mean(taken) / 2
    assert all(
        view.no_field for view, wrong, still in zip(by_both, taken, left, strict=True) if wrong and not still
    )
    assert all(view.borne_out is None and not view.no_field for view in by_vegetation)


def test_no_rows_and_no_picture_stand_out_of_nothing(drawn: SimpleNamespace, beet: CropProfile) -> None:
    grey = np.full((360, 640), 128, np.uint8)
    view = find(drawn.picture(beet, drawn.camera, drawn.stand(beet)), beet, drawn.camera)

    assert share_borne_out(grey, view.lines, beet, drawn.pinhole(640)) == 0
    assert share_borne_out(np.zeros((360, 640, 3), np.uint8), (), beet, drawn.pinhole(640)) == 0
