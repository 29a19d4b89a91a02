"""The drawn cameras: what lies where on the ground appears in its place."""

from dataclasses import replace

import numpy as np
import pytest

from fieldnav.training.canvas import HEIGHT_PX, WIDTH_PX
from fieldnav.training.ground_camera import GroundCamera, draw_camera

PLAIN = GroundCamera(
    focal_px=150.0,
    height=3.0,
    tilt_rad=0.5,
    roll_rad=0.0,
    yaw_rad=0.0,
    centre_x_px=WIDTH_PX / 2,
    squeeze=1.0,
    distortion=0.0,
    hill=0.0,
    aside=0.0,
    bend=0.0,
    cubic=0.0,
)
ALONG = np.linspace(3.0, 60.0, 30)


def test_the_optical_axis_meets_the_ground_in_the_images_centre() -> None:
    ahead = PLAIN.height / np.tan(PLAIN.tilt_rad)

    point = PLAIN.project(np.zeros(1), np.array([ahead]))

    assert point.x_px[0] == pytest.approx(WIDTH_PX / 2)
    assert point.y_px[0] == pytest.approx(HEIGHT_PX / 2)


def test_rows_meet_at_the_horizon() -> None:
    far = PLAIN.project(np.array([-1.0, 0.0, 1.0]), np.full(3, 1e5))

    assert far.y_px == pytest.approx(PLAIN.horizon_px, abs=0.1)
    assert np.ptp(far.x_px) < 0.1


def test_the_scale_is_the_distance_between_neighbouring_rows() -> None:
    left, right = (PLAIN.project(np.full(30, x), ALONG) for x in (0.0, 1.0))

    assert right.x_px - left.x_px == pytest.approx(left.scale_px)


def test_a_mirrored_ground_is_seen_mirrored() -> None:
    camera, mirrored = (replace(PLAIN, yaw_rad=yaw, bend=bend) for yaw, bend in ((0.2, 0.01), (-0.2, -0.01)))

    one, other = camera.project(np.full(30, 0.7), ALONG), mirrored.project(np.full(30, -0.7), ALONG)

    seen = one.scale_px > 0
    assert one.x_px[seen] + other.x_px[seen] == pytest.approx(WIDTH_PX)
    assert one.y_px == pytest.approx(other.y_px)


def test_what_is_behind_the_camera_has_no_scale() -> None:
    assert PLAIN.project(np.zeros(1), np.array([-50.0])).scale_px[0] == 0


@pytest.mark.parametrize("seed", range(50))
def test_a_drawn_camera_sees_one_to_a_dozen_rows(seed: int) -> None:
    camera = draw_camera(np.random.default_rng(seed))

    ground = camera.project(np.zeros(400), np.linspace(-6, 60, 400))

    low = (ground.y_px > 0.6 * HEIGHT_PX) & (ground.y_px < 0.85 * HEIGHT_PX)
    assert low.any(), seed
    assert 0.8 < np.median(WIDTH_PX / ground.scale_px[low]) < 16, seed
