"""Tracking: rows follow the plants, hold when unseen, and stay apart."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import Centres
from fieldnav.perception.perceive import find
from fieldnav.perception.plants import NO_PLANTS, find_plants
from fieldnav.perception.row_end import crop_along_rows
from fieldnav.perception.tracking import TrackedRows, feature, start, track

PERIOD_S = 1 / 15


def plants_seen(drawn: SimpleNamespace, plants_m: np.ndarray, weeds_m: np.ndarray | None = None) -> Centres:
    image = drawn.picture(drawn.beet, drawn.camera, plants_m, weeds_m)
    return find_plants(image, drawn.beet.vegetation, drawn.camera)


def started(drawn: SimpleNamespace) -> TrackedRows:
    lane = find(
        drawn.picture(drawn.beet, drawn.camera, drawn.stand(drawn.beet)), drawn.beet, drawn.camera
    ).lane
    assert lane is not None
    return start(lane, 0.0)


def follow(drawn: SimpleNamespace, rows: TrackedRows, centres: Centres, stamp_s: float) -> TrackedRows:
    return track(rows, centres, stamp_s, drawn.beet, drawn.camera)


def assert_on(
    drawn: SimpleNamespace, rows: TrackedRows, offset_m: float, slope: float, off_px: float
) -> None:
    truth = drawn.rows(drawn.beet, drawn.camera, offset_m, slope)
    for row, true in zip(rows.rows, truth, strict=True):
        assert row.x_bottom_px == pytest.approx(true.x_bottom_px, abs=off_px)
        assert row.x_top_px == pytest.approx(true.x_top_px, abs=off_px)


def test_rows_follow_the_plants(drawn: SimpleNamespace) -> None:
    rows = started(drawn)

    for frame in range(1, 20):
        offset_m, slope = 0.008 * frame, 0.004 * frame
        centres = plants_seen(
            drawn, drawn.stand(drawn.beet, offset_m, slope, ahead_m=(0.6 - 0.01 * frame, 2.2))
        )
        rows = follow(drawn, rows, centres, frame * PERIOD_S)
        assert rows.rows_seen == 3

    assert_on(drawn, rows, offset_m, slope, off_px=8)


@pytest.mark.parametrize("missing", [0, 1, 2])
def test_a_row_not_seen_goes_along_with_the_others(drawn: SimpleNamespace, missing: int) -> None:
    rows = started(drawn)

    for frame in range(1, 16):
        centres = plants_seen(drawn, drawn.stand(drawn.beet, 0.01 * frame, 0.0, without=(missing,)))
        rows = follow(drawn, rows, centres, frame * PERIOD_S)

    assert_on(drawn, rows, 0.15, 0.0, off_px=8)
    assert rows.rows[missing].confidence == 0
    assert rows.rows_seen == 2


def test_rows_hold_their_lines_when_nothing_is_seen(drawn: SimpleNamespace) -> None:
    before = started(drawn)

    rows = follow(drawn, before, NO_PLANTS, 4.0)

    assert rows.rows_seen == 0
    for row, last in zip(rows.rows, before.rows, strict=True):
        assert row.x_bottom_px == pytest.approx(last.x_bottom_px, abs=2)


def test_a_row_that_comes_again_is_seen_again(drawn: SimpleNamespace) -> None:
    whole = plants_seen(drawn, drawn.stand(drawn.beet))
    rows = follow(drawn, started(drawn), NO_PLANTS, 1.0)

    rows = follow(drawn, rows, whole, 2.0)

    assert rows.rows_seen == 3


@pytest.mark.parametrize("seed", range(4))
def test_rows_keep_apart_among_dense_weeds(drawn: SimpleNamespace, seed: int) -> None:
    rows, spacing_m = started(drawn), drawn.beet.rows.spacing_m

    for frame in range(1, 12):
        weeds = drawn.strewn(60, 100 * seed + frame)
        centres = plants_seen(drawn, drawn.stand(drawn.beet, without=(0,)), weeds)
        rows = follow(drawn, rows, centres, frame * PERIOD_S)

    offsets = [
        drawn.camera.row_on_ground(row)[0] + 1.3 * drawn.camera.row_on_ground(row)[1] for row in rows.rows
    ]
    assert -np.diff(offsets) == pytest.approx(np.full(2, spacing_m), abs=0.25 * spacing_m)
    assert offsets[1] == pytest.approx(0, abs=0.03)


def test_tracking_a_mirrored_picture_gives_mirrored_rows(drawn: SimpleNamespace) -> None:
    centres = plants_seen(drawn, drawn.stand(drawn.beet, 0.02, 0.03, scatter_m=0.01))
    flipped = Centres(
        np.array([1279.0, 0]) + centres.position_px * [-1, 1],
        centres.area_px,
        centres.top_px,
        centres.bottom_px,
    )
    rows = started(drawn)
    turned = TrackedRows(
        tuple(type(row)(1279 - row.x_top_px, 1279 - row.x_bottom_px) for row in reversed(rows.rows)),
        rows.stamp_s,
    )

    plain = feature(follow(drawn, rows, centres, 0.1).rows, drawn.camera)
    mirrored = feature(follow(drawn, turned, flipped, 0.1).rows, drawn.camera)

    assert mirrored.offset_px == pytest.approx(-plain.offset_px, abs=1e-6)
    assert mirrored.theta_rad == pytest.approx(-plain.theta_rad, abs=1e-9)


def test_the_feature_is_nought_on_a_centred_lane_and_positive_to_the_right(drawn: SimpleNamespace) -> None:
    centred = feature(tuple(drawn.rows(drawn.beet, drawn.camera)), drawn.camera)
    right = feature(tuple(drawn.rows(drawn.beet, drawn.camera, -0.1, 0.0)), drawn.camera)
    leaning_right = feature(tuple(drawn.rows(drawn.beet, drawn.camera, 0.0, -0.1)), drawn.camera)

    assert (centred.offset_px, centred.theta_rad) == pytest.approx((0, 0), abs=1e-9)
    assert right.offset_px > 50
    assert leaning_right.theta_rad > 0.05


def test_crop_along_the_rows_is_told_in_metres_and_weeds_between_them_count_against_it(
    drawn: SimpleNamespace,
) -> None:
    rows, beet, camera = started(drawn).rows, drawn.beet, drawn.camera
    two = plants_seen(drawn, np.array([[1.0, 0.0], [1.5, 0.35]]), np.array([[1.3, 0.175]]))

    ahead_m, weight = crop_along_rows(two, rows, beet, camera)

    order = np.argsort(ahead_m)
    assert ahead_m[order] == pytest.approx([1.0, 1.3, 1.5], abs=0.02)
    assert (np.sign(weight[order]) == [1, -1, 1]).all()


def test_plants_of_another_lane_are_no_crop_of_this_one(drawn: SimpleNamespace) -> None:
    beside = plants_seen(drawn, np.array([[1.2, 0.62]]))

    ahead_m, _ = crop_along_rows(beside, started(drawn).rows, drawn.beet, drawn.camera)

    assert len(beside) == 1 and len(ahead_m) == 0
