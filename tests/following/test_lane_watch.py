"""Where along the lane a frame was taken, and what either camera's frame adds to what is known of the end."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import CameraName, Direction, Twist
from fieldnav.odometry import Pose
from fieldnav.perception.plants import find_plants
from fieldnav.settings.crop import ControlLaw
from states.lane_watch import driven_m, watch_end

DIRECTIONS = pytest.mark.parametrize("direction", Direction, ids=lambda direction: direction.value)


@DIRECTIONS
def test_a_frame_lies_as_far_back_as_the_robot_has_driven_since(
    direction: Direction, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (8.0,) * 3), direction)
    robot.ticks = 0
    seen = robot.seen((direction.leading,))
    frame = seen.frames[direction.leading]
    late = replace(
        seen,
        forward_m=direction.sign * 5.0,
        pose=Pose(3.0, 4.0),
        exposed={direction.leading: Pose(3.0 - 0.06, 4.0 - 0.08)},
    )

    assert driven_m(late, direction) == pytest.approx(5.0)
    assert driven_m(late, direction, frame) == pytest.approx(4.9)


@DIRECTIONS
def test_plants_behind_that_only_the_trailing_camera_shows_are_crop(
    direction: Direction, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (3.0,) * 3), direction)
    robot.drive("tracking", 2.8)
    late = np.array([[x, y] for x in (3.1, 3.25, 3.4) for y in (-0.35, 0.0, 0.35)])
    while robot.s_m < 4.8:
        robot.obey(Twist(direction.sign * 0.5))
    ended_m = robot.memory.end.judge().crop_until_m
    robot.plants_m = np.concatenate([robot.plants_m, late])
    robot.ticks = 0
    seen = robot.seen((direction.trailing,))
    frame = seen.frames[direction.trailing]
    centres = find_plants(frame.image, crop.vegetation, drawn.camera)
    rows = robot.memory.guide.rows(frame.camera, seen.exposed_at(frame))

    view = watch_end(robot.memory, frame, centres, rows, seen, direction, robot.task)

    assert ended_m == pytest.approx(3.0, abs=0.1)
    assert view.crop_until_m == pytest.approx(3.4, abs=0.1)


def test_a_frame_whose_rows_are_not_known_adds_nothing(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (8.0,) * 3))
    robot.drive("tracking", 2.0)
    before = robot.memory.end.judge()
    robot.ticks = 0
    seen = robot.seen((CameraName.FRONT,))
    frame = seen.frames[CameraName.FRONT]
    centres = find_plants(frame.image, crop.vegetation, drawn.camera)

    view = watch_end(robot.memory, frame, centres, (), seen, Direction.FORWARD, robot.task)

    assert len(centres) > 0 and view == before
