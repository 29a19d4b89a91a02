"""The simulated robot moves as its wheels and the ground make it, and its cameras see what geometry says."""

from collections.abc import Callable, Iterator
from math import radians, sin
from typing import Any

import numpy as np
import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.messages import CameraName, Side, Wheel, WheelSetpoint
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer, View
from fieldnav.simulation.shaking import Attitude, Shaking, rotation
from fieldnav.simulation.world import CORNERING_STIFFNESS, World, module_errors

TICK_S = 0.02
SPEED_MPS = 0.5
READY_S = 2.0
"""By then the modules are up."""

FAULTLESS_CAMERA = {
    "shake_deg": 0.0,
    "bounce_m": 0.0,
    "tilt_error_deg": 0.0,
    "height_error_m": 0.0,
    "focal_error": 0.0,
}
FAULTLESS_WHEELS = {"speed_error": 0.0, "steering_zero_deg": 0.0, "can_delay_s": 0.0}
FAULTLESS: dict[str, Any] = {
    "lanes": 1,
    "length_m": 6,
    "start": {"offset_m": 0.0, "heading_deg": 0.0},
    "rows": {"wander_m": 0.0},
    "ground": {"side_slope_deg": 0.0, "slip": 0.0},
    "camera_errors": FAULTLESS_CAMERA,
    "wheel_errors": FAULTLESS_WHEELS,
}

Setpoints = dict[Wheel, WheelSetpoint]
AHEAD: Setpoints = {wheel: WheelSetpoint(SPEED_MPS, 0.0) for wheel in Wheel}
STANDING: Setpoints = {wheel: WheelSetpoint(0.0, 0.0) for wheel in Wheel}
OPPOSITE = {
    Wheel.FRONT_LEFT: Wheel.FRONT_RIGHT,
    Wheel.FRONT_RIGHT: Wheel.FRONT_LEFT,
    Wheel.REAR_LEFT: Wheel.REAR_RIGHT,
    Wheel.REAR_RIGHT: Wheel.REAR_LEFT,
}


class Driven:
    """A world whose modules are driven through the real driver and bus."""

    def __init__(self, field: FieldSettings, robot: Robot) -> None:
        self.host, self.far_end = open_virtual_pair()
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(robot, self.far_end, errors, field.wheel_errors.can_delay_s)
        self.plan, self.field, self.robot = sow(field, load_crop(field.crop), Side.RIGHT), field, robot
        self.world = World(self.plan, field, robot, modules)
        self.wheels = ThorvaldWheels(robot, self.host)
        self.ticks = 0
        self.wheels.start(0.0)

    def go(self, setpoints: Setpoints, seconds: float, look: Callable[[float], None] | None = None) -> None:
        for _ in range(round(seconds / TICK_S)):
            self.ticks += 1
            now_s = self.ticks * TICK_S
            self.world.advance(now_s)
            self.wheels.poll(now_s)
            if self.wheels.ready:
                self.wheels.command(now_s, setpoints)
            if look:
                look(now_s)

    def close(self) -> None:
        self.host.shutdown()
        self.far_end.shutdown()


Make = Callable[..., Driven]


@pytest.fixture
def driven() -> Iterator[Make]:
    """Makes a world without any fault but those asked for."""
    made: list[Driven] = []

    def make(robot: Robot | None = None, ready: bool = True, **changes: Any) -> Driven:
        field = revised(load_field("demo"), FAULTLESS | changes)
        made.append(Driven(field, robot or load_robot("bonnbot")))
        if ready:
            made[-1].go(STANDING, READY_S)
        return made[-1]

    yield make
    for each in made:
        each.close()


def test_without_faults_the_robot_drives_straight_ahead(driven: Make) -> None:
    run = driven()
    start = run.world.now.pose

    run.go(AHEAD, 4.0)

    end = run.world.now.pose
    assert end.x_m - start.x_m == pytest.approx(4 * SPEED_MPS, abs=0.2)
    assert end.y_m == pytest.approx(start.y_m, abs=1e-6)
    assert end.heading_rad == pytest.approx(start.heading_rad, abs=1e-6)


@pytest.mark.parametrize("slope_deg", [-5.0, 2.0, 8.0])
def test_a_side_slope_drifts_the_robot_downhill_by_the_slip_angle(slope_deg: float, driven: Make) -> None:
    run = driven(ground={"side_slope_deg": slope_deg, "slip": 0.0})
    start = run.world.now.pose

    run.go(AHEAD, 4.0)

    end = run.world.now.pose
    slip_angle = sin(radians(slope_deg)) / CORNERING_STIFFNESS
    assert end.y_m - start.y_m == pytest.approx(-slip_angle * (end.x_m - start.x_m), rel=0.05)
    assert end.heading_rad == pytest.approx(start.heading_rad, abs=1e-6)


def test_slip_costs_way(driven: Make) -> None:
    firm, soft = driven(), driven(ground={"side_slope_deg": 0.0, "slip": 0.2})

    ways = []
    for run in (firm, soft):
        start = run.world.now.pose.x_m
        run.go(AHEAD, 3.0)
        ways.append(run.world.now.pose.x_m - start)

    assert ways[1] == pytest.approx(0.8 * ways[0], rel=1e-3)


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_unequal_wheel_speeds_turn_the_robot_to_the_slower_side(seed: int, driven: Make) -> None:
    run = driven(seed=seed, wheel_errors=FAULTLESS_WHEELS | {"speed_error": 0.1})
    factors = {
        wheel: each.speed_factor for wheel, each in module_errors(run.field.wheel_errors, seed, False).items()
    }
    geometry = run.robot.geometry
    before = run.world.now.pose.heading_rad

    run.go(AHEAD, 3.0)

    turned = run.world.now.pose.heading_rad - before
    faster_right = (
        sum(factors[wheel] * (-1 if geometry.position_m(wheel)[1] > 0 else 1) for wheel in Wheel) / 2
    )
    assert np.sign(turned) == np.sign(faster_right)
    free_rad = faster_right / geometry.track_m * 3.0 * SPEED_MPS
    assert 0.4 * abs(free_rad) < abs(turned) < abs(free_rad), "the wheels that do not slide sideways resist"


def test_a_mirrored_field_gives_the_mirrored_path(driven: Make) -> None:
    errors = {"speed_error": 0.05, "steering_zero_deg": 2.0, "can_delay_s": 0.005}
    disturbed = {
        "start": {"offset_m": 0.1, "heading_deg": 5.0},
        "ground": {"side_slope_deg": 4.0, "slip": 0.05},
        "wheel_errors": errors,
    }
    plain, mirrored = driven(**disturbed), driven(**disturbed, mirrored=True)
    turning = {
        wheel: WheelSetpoint(SPEED_MPS * (1 + 0.1 * index), 0.1 * index) for index, wheel in enumerate(Wheel)
    }

    plain.go(turning, 4.0)
    mirrored.go(
        {
            OPPOSITE[wheel]: WheelSetpoint(each.speed_mps, -each.steering_rad)
            for wheel, each in turning.items()
        },
        4.0,
    )

    one, other = plain.world.now.pose, mirrored.world.now.pose
    assert abs(one.y_m) > 0.05
    assert (other.x_m, other.y_m, other.heading_rad) == pytest.approx(
        (one.x_m, -one.y_m, -one.heading_rad), abs=1e-3
    )


@pytest.mark.parametrize("name", CameraName, ids=lambda name: name.value)
@pytest.mark.parametrize("pitch_deg", [-3.0, 0.0, 4.0])
def test_pitching_moves_the_rows_in_the_picture_as_a_tilt_of_the_camera_does(
    name: CameraName, pitch_deg: float
) -> None:
    settings = load_robot("bonnbot").cameras.get(name)
    pinhole = settings.pinhole()
    looking = 1 if name is CameraName.FRONT else -1
    turned = rotation(Attitude(pitch_rad=radians(pitch_deg)), looking, 0.0, pinhole.tilt_rad)
    view = View(
        pinhole.width_px, pinhole.height_px, pinhole.focal_px, np.array([0.0, 0.0, pinhole.height_m]), turned
    )
    ground = np.array([[ahead, left] for ahead in (0.2, 0.5, 0.9) for left in (-0.4, 0.0, 0.3)])

    seen = np.column_stack([ground, np.full(len(ground), -pinhole.height_m)]) @ view.projection.T
    seen = seen[:, :2] / seen[:, 2:]

    tilted = settings.model_copy(
        update={"tilt_deg": settings.tilt_deg + looking * pitch_deg, "distance_m": 0.0}
    )
    np.testing.assert_allclose(seen, tilted.pinhole().to_image(ground), atol=1e-6)


@pytest.mark.parametrize("name", CameraName, ids=lambda name: name.value)
def test_a_robot_whose_left_side_is_up_sees_what_lies_ahead_moved_aside(name: CameraName) -> None:
    pinhole = load_robot("bonnbot").cameras.get(name).pinhole()
    looking = 1 if name is CameraName.FRONT else -1
    turned = rotation(Attitude(roll_rad=0.02), looking, 0.0, pinhole.tilt_rad)
    view = View(pinhole.width_px, pinhole.height_px, pinhole.focal_px, np.array([0.0, 0.0, 1.0]), turned)

    u, _, depth = view.projection @ np.array([0.5, 0.0, -1.0])

    # The ground turns about the camera: to the robot's right, which the rear camera sees on its left.
    assert u / depth - pinhole.centre_x_px == pytest.approx(
        looking * pinhole.focal_px * sin(0.02) / depth, rel=1e-6
    )


def test_a_robot_that_stands_does_not_shake_and_one_that_drives_does_as_set() -> None:
    errors = load_field("demo").camera_errors.model_copy(update={"shake_deg": 1.0, "bounce_m": 0.02})
    shakings = [Shaking(errors, seed, False) for seed in range(30)]

    standing = [shaking.at(stamp_s, 0.0) for shaking in shakings for stamp_s in np.arange(0, 1, 0.1)]
    driving = [shaking.at(stamp_s, 0.5) for shaking in shakings for stamp_s in np.arange(0, 30, 0.1)]

    assert all(each == Attitude() for each in standing)
    for angles in ([each.roll_rad for each in driving], [each.pitch_rad for each in driving]):
        assert np.std(angles) == pytest.approx(radians(1.0), rel=0.1)
    assert max(abs(each.height_m) for each in driving) < 0.03


def small(robot: Robot) -> Robot:
    """A robot whose cameras give small pictures, which are quickly drawn."""
    cameras = {
        name: getattr(robot.cameras, name).model_copy(update={"width_px": 96, "height_px": 54})
        for name in ("front", "rear")
    }
    return robot.model_copy(update={"cameras": robot.cameras.model_copy(update=cameras)})


def test_frames_come_late_and_some_never_as_set(driven: Make) -> None:
    latency_s, lost = 0.11, 0.3
    run = driven(
        small(load_robot("bonnbot")),
        ready=False,
        camera_errors=FAULTLESS_CAMERA | {"latency_s": latency_s, "lost_frames": lost},
    )
    renderer = FieldRenderer(run.plan, run.field, load_crop(run.field.crop))
    cameras = {name: SimulatedCamera(name, run.world, renderer) for name in CameraName}
    arrived: dict[CameraName, list[tuple[int, float, float]]] = {name: [] for name in CameraName}

    def look(now_s: float) -> None:
        for name, camera in cameras.items():
            frame = camera.latest(now_s)
            if frame and (not arrived[name] or arrived[name][-1][0] != frame.sequence):
                arrived[name].append((frame.sequence, frame.stamp_s, now_s))

    run.go(AHEAD, 10.0, look)

    rate_hz = run.robot.cameras.front.rate_hz
    for frames in arrived.values():
        sequence, stamp_s, seen_s = np.array(frames).T
        late_s = seen_s - stamp_s
        assert (late_s >= latency_s - 1e-9).all() and (late_s < latency_s + 2 * TICK_S).all()
        assert len(frames) / sequence[-1] == pytest.approx(1 - lost, abs=0.1)
        np.testing.assert_allclose(np.diff(stamp_s), np.diff(sequence) / rate_hz, atol=0.011)
    assert arrived[CameraName.FRONT][0][1] != arrived[CameraName.REAR][0][1], "they do not expose at once"


def test_the_same_frame_is_given_until_a_newer_one_arrives(driven: Make) -> None:
    run = driven(small(load_robot("bonnbot")))
    camera = SimulatedCamera(
        CameraName.FRONT, run.world, FieldRenderer(run.plan, run.field, load_crop(run.field.crop))
    )

    run.go(AHEAD, 0.5)
    now_s = run.world.now.stamp_s

    assert camera.latest(now_s) is camera.latest(now_s) is not None
