"""The ground must move through a picture as the wheels say; upside down it does not, and is found out."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import pairwise

import cv2
import numpy as np
import pytest

from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.evaluation.row_end_robot import ObedientWheels, TickingWorld
from fieldnav.messages import CameraName, Frame, Side, Wheel, WheelSetpoint
from fieldnav.mission.motion_vote import MotionVote
from fieldnav.mission.sudden_turn import SuddenTurn
from fieldnav.odometry import Pose
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, load_robot, names_of, revised
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import FieldPlan, sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.world import module_errors

ROBOT = smaller(load_robot("bonnbot"))
FRAME_S = 1 / ROBOT.cameras.front.rate_hz
FOLLOWED_MPS, SIDESTEP_MPS = 0.5, 0.15
NOTICED_M = 1.5
"""An upside-down camera must be found out within so much driving."""
CROPS = names_of(Kind.CROP)
ACROSS_RAD = np.pi / 2
ALONG, BACK, ASIDE = (FOLLOWED_MPS, 0.0), (-FOLLOWED_MPS, 0.0), (SIDESTEP_MPS, ACROSS_RAD)


@cache
def field_of(crop: str) -> tuple[TickingWorld, ObedientWheels, dict[CameraName, SimulatedCamera]]:
    """A weedy, windy field of a crop, drawn as it looks, on which the robot shakes."""
    weeds = load_field("sim-dense-weed").weeds.model_dump(mode="json")
    changes = {"lanes": 2, "length_m": 8, "crop": crop, "wind_mps": 5, "weeds": weeds}
    field, profile = revised(load_field("demo"), changes), load_crop(crop)
    plan: FieldPlan = sow(field, profile, Side.RIGHT)
    wheels = ObedientWheels(module_errors(field.wheel_errors, field.seed, field.mirrored))
    world = TickingWorld(plan, field, ROBOT, wheels)
    renderer = FieldRenderer(plan, field, profile)
    return world, wheels, {name: SimulatedCamera(name, world, renderer) for name in CameraName}


def drive(
    crop: str, camera: CameraName, way: tuple[float, float], metres: float
) -> Iterator[tuple[Frame, Pose]]:
    """What a camera shows from the middle of a lane on, with where each frame was taken."""
    world, wheels, cameras = field_of(crop)
    first_m, last_m = world.plan.lane_span_m(0)
    middle = world.plan.centreline.position((first_m + last_m) / 2, 0.0)
    world.now = replace(world.now, pose=Pose(float(middle[0]), float(middle[1]), world.now.pose.heading_rad))
    wheels.command(0.0, dict.fromkeys(Wheel, WheelSetpoint(*way)))
    taken: dict[float, Pose] = {}
    for _ in range(round(metres / abs(way[0]) / FRAME_S)):
        world.advance(world.now.stamp_s + FRAME_S)
        taken[world.now.stamp_s] = world.now.pose
        frame = cameras[camera].latest(world.now.stamp_s)
        if frame is not None and frame.stamp_s in taken:
            yield frame, taken[frame.stamp_s]


def turned(frame: Frame) -> Frame:
    return replace(frame, image=np.ascontiguousarray(frame.image[::-1, ::-1]))


@pytest.fixture(autouse=True, scope="module")
def _one_thread() -> None:
    cv2.setNumThreads(1)


@pytest.mark.parametrize("crop", CROPS)
@pytest.mark.parametrize("camera", list(CameraName), ids=lambda camera: camera.value)
def test_a_camera_upside_down_is_found_out_before_it_does_harm(camera: CameraName, crop: str) -> None:
    vote = MotionVote(ROBOT.cameras.get(camera).pinhole())
    found = any(vote.against(turned(frame), pose) for frame, pose in drive(crop, camera, ALONG, NOTICED_M))
    assert found, f"{crop}: driven {NOTICED_M} m by a picture that is upside down"


@pytest.mark.parametrize("crop", ["sugar-beet", "potato"])
def test_a_camera_that_is_turned_after_long_trust_is_found_out_as_well(crop: str) -> None:
    vote, front = MotionVote(ROBOT.cameras.front.pinhole()), CameraName.FRONT
    for frame, pose in drive(crop, front, ALONG, 1.0):
        assert not vote.against(frame, pose)
    found = any(vote.against(turned(frame), pose) for frame, pose in drive(crop, front, ALONG, NOTICED_M))
    assert found


@pytest.mark.parametrize("crop", CROPS)
@pytest.mark.parametrize(
    ("camera", "way", "metres"),
    [
        (CameraName.FRONT, ALONG, 1.2),
        (CameraName.REAR, BACK, 1.2),
        (CameraName.REAR, ASIDE, 0.4),
    ],
    ids=["forward", "backward", "sideways"],
)
def test_a_camera_the_right_way_up_is_never_accused(
    camera: CameraName, way: tuple[float, float], metres: float, crop: str
) -> None:
    vote = MotionVote(ROBOT.cameras.get(camera).pinhole())
    for frame, pose in drive(crop, camera, way, metres):
        assert not vote.against(frame, pose), f"accused after {pose}"


@pytest.mark.parametrize("crop", CROPS)
@pytest.mark.parametrize(("camera", "way"), [(CameraName.FRONT, ALONG), (CameraName.REAR, ASIDE)])
def test_a_picture_that_turns_from_one_frame_to_the_next_is_found_out_at_once(
    camera: CameraName, way: tuple[float, float], crop: str
) -> None:
    """Also where the robot hardly moves; and never where the picture has not turned."""
    frames, missed = list(drive(crop, camera, way, 0.3)), 0
    turn = SuddenTurn()
    assert not any(turn.happened(frame, pose) for frame, pose in frames)
    for (before, there), (frame, here) in pairwise(frames):
        turn = SuddenTurn()
        turn.happened(before, there)
        missed += not turn.happened(turned(frame), here)
    assert missed <= 1 + len(frames) // 10


def test_frames_taken_far_apart_tell_nothing_of_a_turn() -> None:
    (first, there), *_, (last, here) = drive("sugar-beet", CameraName.FRONT, ALONG, 0.4)
    turn = SuddenTurn()
    turn.happened(first, there)
    assert not turn.happened(turned(last), here)


def test_front_and_rear_in_each_others_place_are_found_out() -> None:
    vote = MotionVote(ROBOT.cameras.rear.pinhole())
    wrong = (
        (replace(frame, camera=CameraName.REAR), pose)
        for frame, pose in drive("sugar-beet", CameraName.FRONT, ALONG, NOTICED_M)
    )
    assert any(vote.against(frame, pose) for frame, pose in wrong)


def test_ground_without_anything_to_see_accuses_nobody() -> None:
    """Noise alone: nothing moves, whatever the wheels say."""
    vote, random = MotionVote(ROBOT.cameras.front.pinhole()), np.random.default_rng(1)
    size = (ROBOT.cameras.front.height_px, ROBOT.cameras.front.width_px, 3)
    noisy = np.clip(random.normal(100, 3, size), 0, 255).astype(np.uint8)
    for number in range(200):
        image = np.roll(noisy, random.integers(0, size[1], 2), (0, 1))
        pose = Pose(number * FOLLOWED_MPS * FRAME_S, 0.0, 0.0)
        assert not vote.against(Frame(CameraName.FRONT, number, number * FRAME_S, image), pose)


def test_looking_like_turned_again_and_again_accuses_nobody_without_motion_that_says_so() -> None:
    """Bare ground and plants that are drawn alike look turned; half of a verdict must be what was seen."""
    vote, camera = MotionVote(ROBOT.cameras.front.pinhole()), ROBOT.cameras.front
    bare = np.full((camera.height_px, camera.width_px, 3), 100, np.uint8)
    for number in range(200):
        vote.suspect()
        pose = Pose(number * FOLLOWED_MPS * FRAME_S, 0.0, 0.0)
        assert not vote.against(Frame(CameraName.FRONT, number, number * FRAME_S, bare), pose)
