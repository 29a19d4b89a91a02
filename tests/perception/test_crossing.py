"""Rows passing sideways, counted from where plants are seen."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import Centres
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.crossing import accept, follow, new_lane_m
from fieldnav.perception.passing_rows import Crossing, begin, candidate_row, rows_in_image
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

FRAME_M = 0.01
"""0.15 m/s at 15 frames/s."""
PITCH_M = 1.5
ROW_END_M = (1.25, 2.4)
"""The rows begin where the lower half of the trailing view ends."""


def lanes(crop: CropProfile, numbers: Iterable[int], scatter_m: float = 0.015, seed: int = 1) -> np.ndarray:
    """Plants of whole lanes, shape (n, 2), lane 0 under the robot, the others to its left."""
    rng = np.random.default_rng(seed)
    count = crop.rows.per_lane
    plants = []
    for place in (
        lane * PITCH_M + (row - (count - 1) / 2) * crop.rows.spacing_m
        for lane in numbers
        for row in range(count)
    ):
        x = np.arange(*ROW_END_M, crop.plants.spacing_m) + rng.uniform(0, crop.plants.spacing_m)
        plants.append(np.stack([x, place + rng.normal(0, scatter_m, x.shape)], axis=-1))
    return np.concatenate(plants)


def seen(
    plants_m: np.ndarray, moved_m: float, crop: CropProfile, camera: Pinhole, share: float = 1.0
) -> Centres:
    """What the camera sees of the plants when the robot has moved to the left; `share` is their size."""
    plane = canopy_plane(camera, crop)
    at = plane.to_image(plants_m - [0.0, moved_m])
    inside = (at >= 0).all(axis=1) & (at[:, 0] < camera.width_px) & (at[:, 1] < camera.height_px)
    at = at[inside]
    side_px = share * crop.plants.canopy_width_m * plane.pixels_per_metre(at[:, 1])
    return Centres(at, side_px**2, at[:, 1] - side_px / 2, at[:, 1] + side_px / 2)


def mirrored(centres: Centres, camera: Pinhole) -> Centres:
    flipped = np.array([camera.width_px - 1.0, 0.0]) + centres.position_px * [-1, 1]
    return Centres(flipped, centres.area_px, centres.top_px, centres.bottom_px)


def begun(crop: CropProfile, camera: Pinhole, outward: int = 1) -> Crossing:
    plane = canopy_plane(camera, crop)
    count = crop.rows.per_lane
    places = [((count - 1) / 2 - row) * crop.rows.spacing_m for row in range(count)]
    return begin(tuple(plane.row_in_image(place, 0.0) for place in places), outward, crop, camera)


def step(crossing: Crossing, centres: Centres, crop: CropProfile, camera: Pinhole) -> Crossing:
    """One frame; a row that is shown long enough is taken for new."""
    crossing = follow(crossing, centres, crop, camera)
    return accept(crossing, crop) if candidate_row(crossing, crop, camera) else crossing


def walk(
    crossing: Crossing, plants_m: np.ndarray, ways_m: Sequence[float], crop: CropProfile, camera: Pinhole
) -> list[Crossing]:
    steps = []
    for moved_m in ways_m:
        centres = seen(plants_m, moved_m, crop, camera)
        if crossing.outward < 0:
            centres = mirrored(centres, camera)
        crossing = step(crossing, centres, crop, camera)
        steps.append(crossing)
    return steps


def profile(drawn: SimpleNamespace, rows: int, spacing_m: float) -> CropProfile:
    crop: CropProfile = drawn.profile(per_lane=rows, spacing_m=spacing_m)
    return crop


@pytest.mark.parametrize("outward", [1, -1], ids=["to the left", "to the right"])
@pytest.mark.parametrize(("rows", "spacing_m"), [(3, 0.35), (2, 0.55), (4, 0.25), (1, 0.5)])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_rows_of_the_next_lane_are_counted_exactly(
    drawn: SimpleNamespace, outward: int, rows: int, spacing_m: float, seed: int
) -> None:
    crop, camera = profile(drawn, rows, spacing_m), drawn.camera
    field = lanes(crop, (0, 1, 2), seed=seed)

    steps = walk(begun(crop, camera, outward), field, np.arange(0, PITCH_M, FRAME_M), crop, camera)

    counts = [each.passed for each in steps]
    assert counts[0] == 0 and counts[-1] == rows
    assert all(0 <= after - before <= 1 for before, after in pairwise(counts))
    left_m = PITCH_M - (len(steps) - 1) * FRAME_M
    assert new_lane_m(steps[-1], crop) == pytest.approx(left_m, abs=0.05)


def test_a_mirrored_field_gives_the_same_crossing(drawn: SimpleNamespace) -> None:
    crop, camera = profile(drawn, 3, 0.35), drawn.camera
    field, ways = lanes(crop, (0, 1)), np.arange(0, 1.2, FRAME_M)

    left = walk(begun(crop, camera, 1), field, ways, crop, camera)[-1]
    right = walk(begun(crop, camera, -1), field, ways, crop, camera)[-1]

    assert [row.number for row in left.rows] == [row.number for row in right.rows]
    np.testing.assert_allclose(
        [row.across_m for row in left.rows], [row.across_m for row in right.rows], atol=1e-6
    )
    assert left.slope == pytest.approx(-right.slope, abs=1e-6)


def test_weeds_between_the_lanes_are_dropped_once_a_row_shows_that_they_were_none(
    drawn: SimpleNamespace,
) -> None:
    crop, camera = profile(drawn, 3, 0.35), drawn.camera
    weeds = np.array([[1.6, 0.61], [1.65, 0.61], [1.7, 0.62], [1.75, 0.6]])
    field = np.concatenate([lanes(crop, (0, 1)), weeds])

    steps = walk(begun(crop, camera), field, np.arange(0, PITCH_M, FRAME_M), crop, camera)

    first = next(each for each in steps if each.passed)
    assert first.outermost.across_m + 0.3 < 1.15, "the weeds are taken for a row at first"
    assert steps[-1].passed == 3
    assert new_lane_m(steps[-1], crop) == pytest.approx(FRAME_M, abs=0.03)


def test_standing_still_counts_nothing_twice(drawn: SimpleNamespace) -> None:
    crop, camera = profile(drawn, 3, 0.35), drawn.camera
    field = lanes(crop, (0, 1))
    there = walk(begun(crop, camera), field, np.arange(0, 0.8, FRAME_M), crop, camera)[-1]

    after = walk(there, field, [0.79] * 60, crop, camera)

    assert there.passed > 0
    assert {each.passed for each in after} == {there.passed}


def test_moving_back_and_forth_counts_nothing_twice(drawn: SimpleNamespace) -> None:
    crop, camera = profile(drawn, 3, 0.35), drawn.camera
    field = lanes(crop, (0, 1))
    ways = np.concatenate(
        [np.arange(0, 0.9, FRAME_M), np.arange(0.9, 0.5, -FRAME_M), np.arange(0.5, 1.5, FRAME_M)]
    )

    counts = [each.passed for each in walk(begun(crop, camera), field, ways, crop, camera)]

    assert counts[-1] == 3
    assert counts == sorted(counts)


def test_a_bare_headland_counts_nothing(drawn: SimpleNamespace) -> None:
    crop, camera = profile(drawn, 3, 0.35), drawn.camera

    steps = walk(begun(crop, camera), lanes(crop, (0,)), np.arange(0, 1.5, FRAME_M), crop, camera)

    assert {each.passed for each in steps} == {0}
    with pytest.raises(ValueError, match="no new row"):
        new_lane_m(steps[-1], crop)


def test_the_heading_is_seen_from_the_plants(drawn: SimpleNamespace) -> None:
    crop, camera = profile(drawn, 3, 0.35), drawn.camera
    slope = 0.05
    field = lanes(crop, (0,), scatter_m=0.0)
    turned = field + np.stack([np.zeros(len(field)), slope * field[:, 0]], axis=-1)
    crossing = begun(crop, camera)

    for _ in range(60):
        crossing = follow(crossing, seen(turned, 0.0, crop, camera), crop, camera)

    assert crossing.slope == pytest.approx(slope, abs=0.01)
    assert len(rows_in_image(crossing, crop, camera)) == 3
