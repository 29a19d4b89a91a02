"""The two guides behind one interface: what they tell of the rows in each camera, and how they steer."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import CameraName, Direction, Steering, Twist
from fieldnav.odometry import Pose
from fieldnav.perception.plants import find_plants
from fieldnav.settings.crop import ControlLaw
from states.guides import guide_for, steering_of
from states.paper_guide import AGREEING_FRAMES, PaperGuide
from states.path_guide import PathGuide

LAWS = pytest.mark.parametrize("law", ControlLaw, ids=lambda law: law.value)
DIRECTIONS = pytest.mark.parametrize("direction", Direction, ids=lambda direction: direction.value)
CAMERAS = pytest.mark.parametrize("leads", [True, False], ids=["leading", "trailing"])


def camera_of(direction: Direction, leads: bool) -> CameraName:
    return direction.leading if leads else direction.trailing


def look(robot: SimpleNamespace, name: CameraName) -> SimpleNamespace:
    """Show the guide what a camera sees now."""
    robot.ticks = 0  # of a frame
    frame = robot.seen((name,)).frames[name]
    crop = robot.task.crop
    centres = find_plants(frame.image, crop.vegetation, robot.task.cameras[name])
    return robot.memory.guide.look(frame, centres, robot.reckoned)


def bottoms_px(rows: tuple[SimpleNamespace, ...]) -> list[float]:
    return [row.x_bottom_px for row in rows]


def test_the_profile_chooses_the_guide_and_how_the_wheels_stand(drawn: SimpleNamespace) -> None:
    paper, path = (drawn.profile(law) for law in (ControlLaw.PAPER, ControlLaw.PATH_FOLLOWING))
    task = drawn.robot(path, drawn.lane(path, (4.0,) * 3)).task

    assert isinstance(guide_for(task, Direction.FORWARD), PathGuide)
    other = type(task)(paper, task.cameras, task.side, task.lanes)
    assert isinstance(guide_for(other, Direction.FORWARD), PaperGuide)
    assert steering_of(paper) is Steering.DIFFERENTIAL
    assert steering_of(path) is Steering.OMNIDIRECTIONAL


@LAWS
@DIRECTIONS
@CAMERAS
def test_the_rows_told_are_those_seen_left_to_right(
    law: ControlLaw, direction: Direction, leads: bool, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3), direction)
    robot.drive("tracking", 3.0)
    name = camera_of(direction, leads)

    looks = [look(robot, name) for _ in range(AGREEING_FRAMES)]

    camera = robot.task.cameras[name]
    told = bottoms_px(looks[-1].rows)
    assert looks[-1].rows_seen == crop.rows.per_lane
    assert told == sorted(told)
    assert np.mean(told) == pytest.approx(camera.centre_x_px, abs=8)
    assert all(row.confidence > 0.9 for row in looks[-1].rows)
    assert bottoms_px(robot.memory.guide.rows(name, robot.reckoned)) == pytest.approx(told, abs=0.01)


@DIRECTIONS
@CAMERAS
def test_a_row_that_is_gone_is_the_one_told_as_unseen(
    direction: Direction, leads: bool, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3), direction)
    robot.drive("tracking", 3.0)
    robot.plants_m = robot.plants_m[robot.plants_m[:, 1] < 0.2]  # the left row, in the direction of travel

    looked = look(robot, camera_of(direction, leads))

    seen = [row.confidence > 0 for row in looked.rows]
    assert looked.rows_seen == 2
    assert seen == ([False, True, True] if leads else [True, True, False])


@LAWS
@DIRECTIONS
@pytest.mark.parametrize("left_m", [0.06, -0.06])
@CAMERAS
def test_a_robot_beside_its_lane_is_steered_towards_it_by_either_camera(
    law: ControlLaw, direction: Direction, left_m: float, leads: bool, drawn: SimpleNamespace
) -> None:
    crop = drawn.profile(law)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3), direction, left_m=left_m)
    name = camera_of(direction, leads)
    for _ in range(AGREEING_FRAMES):
        look(robot, name)

    motion = robot.memory.guide.motion(robot.reckoned, 0.5, name)

    heading = robot.true.heading_rad
    aside = motion.twist.vx_mps * np.sin(heading) + motion.twist.vy_mps * np.cos(heading)
    turned = motion.twist.yaw_rate_rps
    assert direction.sign * motion.twist.vx_mps == 0.5
    assert (aside if law is ControlLaw.PATH_FOLLOWING else turned) * left_m < -1e-4
    assert motion.steering is steering_of(crop)


def test_the_papers_guide_finds_the_trailing_rows_by_itself(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PAPER)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3))
    robot.drive("tracking", 3.0)
    guide = robot.memory.guide

    straight_on = guide.motion(robot.reckoned, 0.5, CameraName.REAR)
    looks = [look(robot, CameraName.REAR).rows_seen for _ in range(AGREEING_FRAMES + 1)]

    assert (straight_on.twist.vx_mps, straight_on.twist.yaw_rate_rps) == (0.5, 0.0)
    assert looks == [0] * (AGREEING_FRAMES - 1) + [3] * 2
    guide.motion(robot.reckoned, 0.5, CameraName.REAR)
    assert guide.feature and {each.unit for each in guide.evidence(robot.reckoned)} == {"px", "deg"}


def test_the_papers_guide_does_not_go_by_rows_that_a_camera_showed_long_ago(drawn: SimpleNamespace) -> None:
    """An exit that turned out to be a gap leaves rows of the trailing camera; at the next they have moved."""
    crop = drawn.profile(ControlLaw.PAPER)
    robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3))
    for _ in range(AGREEING_FRAMES):
        look(robot, CameraName.REAR)
    before = bottoms_px(robot.memory.guide.rows(CameraName.REAR, robot.reckoned))
    robot.now_s += 20.0
    robot.plants_m = robot.plants_m + np.array([0.0, 0.17])

    looks = [look(robot, CameraName.REAR) for _ in range(AGREEING_FRAMES)]

    assert looks[0].rows == () and looks[-1].rows_seen == 3
    after = bottoms_px(looks[-1].rows)
    assert np.abs(np.subtract(after, before)).min() > 10


def test_the_lanes_path_is_lost_when_it_is_uncertain_and_the_papers_rows_never_are(
    drawn: SimpleNamespace,
) -> None:
    for law, says in ((ControlLaw.PATH_FOLLOWING, "uncertain"), (ControlLaw.PAPER, "")):
        crop = drawn.profile(law)
        robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3))
        robot.drive("tracking", 3.0)
        guide = robot.memory.guide
        assert guide.lost(robot.reckoned) == ""
        robot.plants_m = robot.plants_m[:0]
        for _ in range(60):
            robot.reckoned = Pose(robot.reckoned.x_m + 0.1, robot.reckoned.y_m)
            robot.now_s += 0.2
            look(robot, CameraName.FRONT)
        assert says in guide.lost(robot.reckoned) and bool(guide.lost(robot.reckoned)) == bool(says)


def test_after_a_gap_rows_are_looked_for_further_aside(drawn: SimpleNamespace) -> None:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    seen = []
    for blind_m in (0.0, 2.5):
        robot = drawn.robot(crop, drawn.lane(crop, (12.0,) * 3))
        robot.drive("tracking", 3.0)
        for _ in range(round(blind_m / 0.02)):
            robot.obey(Twist(0.3))
        robot.plants_m = robot.plants_m + np.array([0.0, -0.15])
        seen.append(look(robot, CameraName.FRONT).rows_seen)

    assert seen[0] == 0 and seen[1] >= 2
