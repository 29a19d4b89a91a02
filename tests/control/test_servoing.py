"""The servoing law against the camera's geometry, and in a closed loop with a robot's kinematics."""

from math import atan2, cos, degrees, pi, radians, sin, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.control.servoing import interaction_matrix, robot_to_camera, yaw_rate
from fieldnav.messages import CameraName, Direction, RowLine
from fieldnav.perception.tracking import Feature, feature
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import Servoing
from fieldnav.settings.loading import load_robot

SERVOING = Servoing()
FRAME_S = 1 / 15
TOP_YAW_RPS = 0.5
SMALL = 1e-6

CAMERAS = st.builds(
    lambda height_m, tilt_deg, forward_m: Pinhole(1280, 720, 931.0, height_m, radians(tilt_deg), forward_m),
    st.floats(0.5, 2.0),
    st.floats(35, 85),
    st.floats(0, 1.5),
)


def line_after(
    line: tuple[float, float], ahead_m: float, left_m: float, turn_rad: float
) -> tuple[float, float]:
    """A ground line, (offset, slope), as the robot sees it after moving and turning."""
    offset, slope = line
    start, along = np.array([0.0, offset]) - (ahead_m, left_m), np.array([1.0, slope])
    back = np.array([[cos(turn_rad), sin(turn_rad)], [-sin(turn_rad), cos(turn_rad)]])
    start, along = back @ start, back @ along
    slope = along[1] / along[0]
    return float(start[1] - slope * start[0]), float(slope)


def seen(camera: Pinhole, line: tuple[float, float]) -> np.ndarray:
    """A ground line's feature: X where it meets the bottom edge, over the focal length, and theta."""
    row: RowLine = camera.row_in_image(*line)
    found = feature((row,), camera)
    return np.array([found.offset_px / camera.focal_px, found.theta_rad])


@given(camera=CAMERAS, offset_m=st.floats(-0.4, 0.4), slope=st.floats(-0.3, 0.3))
def test_the_interaction_matrix_is_the_derivative_of_the_projection(
    camera: Pinhole, offset_m: float, slope: float
) -> None:
    line = (offset_m, slope)
    x, theta = seen(camera, line)
    matrix = interaction_matrix(x, camera.centre_y_px / camera.focal_px, theta, camera)
    sideways = np.array([[-1.0, 0, 0, 0, 0, 0]]).T  # to the robot's left is the camera's negative x
    predicted = matrix @ np.hstack([robot_to_camera(camera), sideways])

    moves = [(SMALL, 0.0, 0.0), (0.0, 0.0, SMALL), (0.0, SMALL, 0.0)]
    there = np.array([seen(camera, line_after(line, ahead, left, turn)) for ahead, left, turn in moves])
    back = np.array([seen(camera, line_after(line, -ahead, -left, -turn)) for ahead, left, turn in moves])

    np.testing.assert_allclose(predicted, ((there - back) / (2 * SMALL)).T, atol=1e-5, rtol=1e-5)


@given(
    camera=CAMERAS,
    offset_px=st.floats(-600, 600),
    theta_rad=st.floats(-0.8, 0.8),
    speed_mps=st.floats(0.05, 1.5) | st.floats(-1.5, -0.05),
)
def test_a_mirrored_feature_gives_the_negated_yaw_rate(
    camera: Pinhole, offset_px: float, theta_rad: float, speed_mps: float
) -> None:
    plain = yaw_rate(Feature(offset_px, theta_rad), camera, speed_mps, SERVOING)
    mirrored = yaw_rate(Feature(-offset_px, -theta_rad), camera, speed_mps, SERVOING)

    assert mirrored == pytest.approx(-plain, abs=1e-9)


def test_on_the_lane_and_at_standstill_there_is_nothing_to_steer() -> None:
    camera = load_robot("bonnbot").cameras.front.pinhole()

    assert yaw_rate(Feature(0.0, 0.0), camera, 0.5, SERVOING) == pytest.approx(0.0, abs=1e-12)
    assert yaw_rate(Feature(80.0, 0.2), camera, 0.0, SERVOING) == 0.0


def drive(
    name: CameraName, direction: Direction, speed_mps: float, off_m: float, turned_deg: float, way_m: float
) -> tuple[np.ndarray, np.ndarray]:
    """Distance from the lane's line, m, and angle to it, deg, of a robot that obeys the law."""
    camera = load_robot("bonnbot").cameras.get(name).pinhole()
    looking = 1 if name is CameraName.FRONT else -1
    looking_mps = speed_mps * direction.sign * looking
    y, heading = off_m, radians(turned_deg)
    path = []
    for _ in range(round(way_m / speed_mps / FRAME_S)):
        view = heading if looking > 0 else heading + pi
        line = camera.row_in_image(-y / cos(view), -tan(view))
        rate = yaw_rate(feature((line,), camera), camera, looking_mps, SERVOING)
        rate = max(-TOP_YAW_RPS, min(TOP_YAW_RPS, rate))
        middle = heading + rate * FRAME_S / 2
        y += direction.sign * speed_mps * FRAME_S * sin(middle)
        heading += rate * FRAME_S
        path.append((y, degrees(atan2(sin(heading), cos(heading)))))
    offsets, angles = np.array(path).T
    return offsets, angles


@pytest.mark.parametrize("start", [(0.25, 15), (0.25, -15), (-0.25, 15), (-0.25, -15), (0.25, 0), (0.0, 15)])
@pytest.mark.parametrize("speed_mps", [0.2, 0.5, 1.0])
@pytest.mark.parametrize("direction", Direction, ids=lambda direction: direction.value)
@pytest.mark.parametrize("name", CameraName, ids=lambda name: name.value)
def test_the_robot_comes_onto_the_lane_and_stays(
    name: CameraName, direction: Direction, speed_mps: float, start: tuple[float, float]
) -> None:
    offsets, angles = drive(name, direction, speed_mps, *start, way_m=8.0)

    settled = len(offsets) * 3 // 4
    assert np.abs(offsets[settled:]).max() < 0.01
    assert np.abs(angles[settled:]).max() < 0.5
    assert np.abs(offsets).max() < 0.6, "it does not leave the lane on the way"
