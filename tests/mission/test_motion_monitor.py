"""What the wheels say must be seen: pictures that stand still, lag, jump or are turned are found out."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from math import hypot
from typing import Any

import cv2
import numpy as np
import pytest

from fieldnav.errors import DriverError
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.evaluation.row_end_robot import ObedientWheels, TickingWorld
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import CameraName, Frame, Image, Side, Wheel, WheelSetpoint
from fieldnav.mission.picture_watch import PictureWatch
from fieldnav.odometry import Pose, Track
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, load_robot, names_of, revised
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import FieldPlan, sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.world import module_errors

ROBOT = smaller(load_robot("bonnbot"))
TILT_DEG = ROBOT.cameras.front.tilt_deg
OBLIQUE_DEG = (35, 45)
FRAME_S = 1 / ROBOT.cameras.front.rate_hz
MAX_DELAY_S = ROBOT.timeouts.frame_s
FOLLOWED_MPS, SIDESTEP_MPS = 0.5, 0.15
NOTICED_M, TURNED_M = 0.5, 1.8
"""Pictures of the past must be found out within so much driving; and pictures that are turned."""
CROPS = names_of(Kind.CROP)
SOME_CROPS = ("sugar-beet", "winter-wheat", "maize")
ACROSS_RAD = np.pi / 2
ALONG, BACK, ASIDE = (FOLLOWED_MPS, 0.0), (-FOLLOWED_MPS, 0.0), (SIDESTEP_MPS, ACROSS_RAD)
FRONT, REAR = CameraName.FRONT, CameraName.REAR

Shown = Callable[[list[Frame]], Image]
"""What is shown instead of the newest of the frames taken so far."""


@cache
def tilted(tilt_deg: float) -> Robot:
    cameras: dict[str, dict[str, Any]] = ROBOT.model_dump(mode="json")["cameras"]
    return revised(ROBOT, {"cameras": {name: it | {"tilt_deg": tilt_deg} for name, it in cameras.items()}})


@cache
def field_of(
    crop: str, tilt_deg: float
) -> tuple[TickingWorld, ObedientWheels, dict[CameraName, SimulatedCamera]]:
    """A weedy, windy field of a crop, drawn as it looks, on which the robot shakes."""
    weeds = load_field("sim-dense-weed").weeds.model_dump(mode="json")
    changes = {"lanes": 1, "length_m": 18, "crop": crop, "wind_mps": 5, "weeds": weeds}
    field, profile = revised(load_field("demo"), changes), load_crop(crop)
    plan: FieldPlan = sow(field, profile, Side.RIGHT)
    wheels = ObedientWheels(module_errors(field.wheel_errors, field.seed, field.mirrored))
    world = TickingWorld(plan, field, tilted(tilt_deg), wheels)
    renderer = FieldRenderer(plan, field, profile)
    return world, wheels, {name: SimulatedCamera(name, world, renderer) for name in CameraName}


class Drive:
    """A camera on a robot that starts in the middle of a lane; driven_m: what it has come since the lie
    began."""

    def __init__(
        self, crop: str, camera: CameraName, way: tuple[float, float] = ALONG, tilt_deg: float = TILT_DEG
    ) -> None:
        self.world, self._wheels, cameras = field_of(crop, tilt_deg)
        first_m, last_m = self.world.plan.lane_span_m(0)
        along_m = {ALONG: first_m + 1.0, BACK: last_m - 1.0}.get(way, (first_m + last_m) / 2)
        middle = self.world.plan.centreline.position(along_m, 0.0)
        start = Pose(float(middle[0]), float(middle[1]), self.world.now.pose.heading_rad)
        self.world.now = replace(self.world.now, pose=start)
        self._camera, self.way, self._begun_s = cameras[camera], way, self.world.now.stamp_s
        self.watch = PictureWatch(tilted(tilt_deg).cameras.get(camera).pinhole(), MAX_DELAY_S)
        self.track, self.frames, self.driven_m = Track(300), list[Frame](), 0.0
        self.said: list[Trouble] = []

    def go(self, metres: float, shown: Shown | None = None) -> FaultKind | None:
        """Drive, looking at what is shown; the fault that the pictures are refused for, if they are."""
        self.driven_m = 0.0
        for frame in self._frames(metres):
            self.frames.append(frame)
            image = shown(self.frames) if shown else frame.image
            try:
                found = self.watch.objection(replace(frame, image=image), self.track)
            except DriverError as error:
                return error.fault
            self.said += [found] if found else []
        return None

    def _frames(self, metres: float) -> Iterator[Frame]:
        """Each new frame; the speed is what the watch leaves of it, as the loop drives."""
        speed_mps, angle_rad = self.way
        while self.driven_m < metres:
            slowed_mps = speed_mps * self.watch.motion.speed_share
            self._wheels.command(
                self.world.now.stamp_s, dict.fromkeys(Wheel, WheelSetpoint(slowed_mps, angle_rad))
            )
            before = self.world.now.pose
            self.world.advance(self.world.now.stamp_s + FRAME_S)
            here = self.world.now.pose
            self.driven_m += hypot(here.x_m - before.x_m, here.y_m - before.y_m)
            self.track.add(self.world.now.stamp_s, here)
            frame = self._camera.latest(self.world.now.stamp_s)
            known_s = self.frames[-1].stamp_s if self.frames else self._begun_s
            if frame is not None and frame.stamp_s > known_s:
                yield frame


@pytest.fixture(autouse=True, scope="module")
def one_thread() -> Iterator[None]:
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    yield
    cv2.setNumThreads(threads)


def turned(frames: list[Frame]) -> Image:
    return np.ascontiguousarray(frames[-1].image[::-1, ::-1])


def with_clock(image: Image, count: int, share: float = 0.02) -> Image:
    """A bar that grows and starts over, in a box across the picture that is so much of it."""
    shown, height = image.copy(), round(share * len(image))
    shown[:height] = np.random.default_rng(count).integers(0, 99, shown[:height].shape)
    shown[:height, : 8 * (1 + count % 10)] = 255
    return shown


@pytest.mark.parametrize(
    "crop",
    [name if name in SOME_CROPS else pytest.param(name, marks=pytest.mark.long) for name in CROPS],
)
@pytest.mark.parametrize(("camera", "way"), [(FRONT, ALONG), (REAR, BACK), (REAR, ASIDE)])
def test_pictures_that_move_as_the_wheels_say_are_never_accused(
    camera: CameraName, way: tuple[float, float], crop: str
) -> None:
    drive = Drive(crop, camera, way)
    assert drive.go(1.5 if way is not ASIDE else 0.4) is None
    assert not drive.said


@pytest.mark.parametrize("tilt_deg", OBLIQUE_DEG)
def test_a_camera_that_looks_obliquely_is_accused_only_once_its_pictures_freeze_or_are_old(
    tilt_deg: float,
) -> None:
    drive, late = Drive("sugar-beet", FRONT, tilt_deg=tilt_deg), round(2.0 / FRAME_S)
    assert drive.go(1.5) is None
    assert not drive.said and not drive.watch.motion.delay_s
    still = drive.frames[-1].image
    assert drive.go(0.1, lambda frames: with_clock(still, len(frames))) is None
    assert {each.fault for each in drive.said} == {FaultKind.CAMERA_FROZEN}
    assert drive.go(2.0, lambda frames: frames[-1 - late].image) is FaultKind.CAMERA_PAST
    assert drive.driven_m <= NOTICED_M


@pytest.mark.parametrize("crop", SOME_CROPS)
def test_a_frozen_picture_with_a_running_clock_in_it_is_found_out(crop: str) -> None:
    drive = Drive(crop, FRONT)
    assert drive.go(1.0) is None
    still = drive.frames[-1].image
    assert drive.go(0.1, lambda frames: with_clock(still, len(frames))) is None
    assert {each.fault for each in drive.said} == {FaultKind.CAMERA_FROZEN}
    assert "the same picture, but for 2% of it, for" in drive.said[0].said


@pytest.mark.parametrize("crop", SOME_CROPS)
def test_a_frozen_picture_of_which_much_runs_on_is_found_out(crop: str) -> None:
    drive = Drive(crop, FRONT)
    assert drive.go(1.0) is None
    still = drive.frames[-1].image
    fault = drive.go(2.0, lambda frames: with_clock(still, len(frames), share=0.15))
    assert fault is FaultKind.CAMERA_PAST
    assert drive.driven_m <= NOTICED_M


@pytest.mark.parametrize("apart", [1, 6, 20])
@pytest.mark.parametrize("crop", ["sugar-beet", "soybean", "winter-wheat"])
def test_two_old_pictures_in_turn_are_found_out(crop: str, apart: int) -> None:
    drive = Drive(crop, FRONT)
    assert drive.go(1.0) is None
    pair = (drive.frames[-1].image, drive.frames[-1 - apart].image)
    fault = drive.go(2.0, lambda frames: pair[len(frames) % 2])
    assert fault is FaultKind.CAMERA_PAST
    assert drive.driven_m <= NOTICED_M


@pytest.mark.parametrize("crop", SOME_CROPS)
def test_pictures_that_suddenly_are_old_are_found_out(crop: str) -> None:
    """Three seconds old, with new stamps: the ground moves as it should, but it is other ground."""
    drive, late = Drive(crop, FRONT), round(3.0 / FRAME_S)
    assert drive.go(2.5) is None  # as long as the oldest picture that is shown
    fault = drive.go(2.0, lambda frames: frames[-1 - late].image)
    assert fault is FaultKind.CAMERA_PAST
    assert drive.driven_m <= NOTICED_M


def test_pictures_that_are_late_by_less_than_the_limit_are_measured_and_allowed_for() -> None:
    late_s = 0.3
    late, drive = round(late_s / FRAME_S), Drive("sugar-beet", FRONT)
    for speed_mps in (0.2, 0.5, 0.3, 0.5, 0.3, 0.5):
        drive.way = (speed_mps, 0.0)
        assert drive.go(0.5, lambda frames: frames[max(0, len(frames) - 1 - late)].image) is None
    delay = drive.watch.motion.delay
    assert delay.mean_s == pytest.approx(late_s, abs=2 * delay.sd_s)
    assert drive.watch.motion.delay_s == delay.mean_s


def test_a_delay_that_grows_by_50_ms_a_second_is_found_out_before_the_robot_would_leave_its_lane() -> None:
    """From a second of delay on the lane is followed worse, by centimetres."""
    drive = Drive("sugar-beet", FRONT)
    assert drive.go(1.0) is None
    begun_s = drive.frames[-1].stamp_s

    def grown_s(frames: list[Frame]) -> float:
        return 0.05 * (frames[-1].stamp_s - begun_s)

    def shown(frames: list[Frame]) -> Image:
        return frames[-1 - round(grown_s(frames) / FRAME_S)].image

    assert drive.go(14.0, shown) is FaultKind.CAMERA_PAST
    assert MAX_DELAY_S < grown_s(drive.frames) < 1.2


@pytest.mark.parametrize("crop", SOME_CROPS)
@pytest.mark.parametrize(("camera", "way"), [(FRONT, ALONG), (REAR, BACK)])
def test_a_camera_upside_down_is_found_out(camera: CameraName, way: tuple[float, float], crop: str) -> None:
    drive = Drive(crop, camera, way)
    assert drive.go(2.0, turned) in (FaultKind.CAMERA_TURNED, FaultKind.CAMERA_PAST)
    assert drive.driven_m <= TURNED_M


@pytest.mark.parametrize("crop", ["sugar-beet", "potato"])
def test_a_camera_that_is_turned_after_long_trust_is_found_out_as_well(crop: str) -> None:
    drive = Drive(crop, FRONT)
    assert drive.go(1.0) is None
    assert drive.go(2.0, turned) in (FaultKind.CAMERA_TURNED, FaultKind.CAMERA_PAST)
    assert drive.driven_m <= TURNED_M


def test_mirrored_pictures_are_found_out_when_the_robot_moves_sideways() -> None:
    drive = Drive("sugar-beet", REAR, ASIDE)
    fault = drive.go(1.0, lambda frames: np.ascontiguousarray(frames[-1].image[:, ::-1]))
    assert fault is FaultKind.CAMERA_TURNED
    assert drive.driven_m <= NOTICED_M


@pytest.mark.parametrize("crop", SOME_CROPS)
def test_plants_that_must_be_in_view_do_not_vanish(crop: str) -> None:
    """Mud, another colour, a lens cap with light behind it: whatever hides the crop is no end of a row."""
    drive, random = Drive(crop, FRONT), np.random.default_rng(1)
    assert drive.go(0.5) is None
    height, width = drive.frames[-1].image.shape[:2]
    blotches = np.kron(random.normal(0, 4, (height // 20, width // 20, 1)), np.ones((20, 20, 1)))
    mud = np.clip(blotches + random.normal((40, 60, 85), 3, (height, width, 3)), 0, 255).astype(np.uint8)
    assert drive.go(0.2, lambda frames: np.roll(mud, len(frames), 0)) is None
    assert {each.fault for each in drive.said} == {FaultKind.CAMERA_BLIND}
    assert "of the plants that must be in view are" in drive.said[0].said


def test_noise_alone_shows_no_crop_and_accuses_nobody_of_more() -> None:
    """Nothing moves, whatever the wheels say."""
    watch, random = PictureWatch(ROBOT.cameras.front.pinhole(), MAX_DELAY_S), np.random.default_rng(1)
    size = (ROBOT.cameras.front.height_px, ROBOT.cameras.front.width_px, 3)
    noisy = np.clip(random.normal((70, 95, 120), 3, size), 0, 255).astype(np.uint8)
    track = Track(300)
    for number in range(200):
        track.add(number * FRAME_S, Pose(number * FOLLOWED_MPS * FRAME_S, 0.0, 0.0))
        image = np.roll(noisy, random.integers(0, size[1], 2), (0, 1))
        found = watch.objection(Frame(FRONT, number, number * FRAME_S, image), track)
        assert found is not None and found.fault is FaultKind.CAMERA_BLIND
