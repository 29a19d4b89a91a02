"""The path estimate and the path following law together, on a robot with all its faults, driven to the lane.

Plants stand on the ground as a crop profile says and are seen as points, late and shaken; wheels ramp, steer
at a finite rate, and differ from what they report; the ground slopes and slips.
"""

from collections import deque
from dataclasses import dataclass
from math import cos, degrees, radians, sin, tan

import numpy as np
import pytest

from drivers.simulated_motion import SimulatedMotion
from fieldnav.control.kinematics import body_twist, wheel_setpoints
from fieldnav.control.limits import limit
from fieldnav.control.path_following import follow_path
from fieldnav.estimation.lane_path import LanePath
from fieldnav.estimation.sighting import Sighting
from fieldnav.messages import STANDSTILL, Motion, Steering, Twist, Wheel, WheelSetpoint
from fieldnav.odometry import Pose
from fieldnav.perception.follow import scatter_m, widest_m
from fieldnav.perception.lane import comb_m
from fieldnav.settings.crop import Control, CropProfile
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_robot, names_of
from fieldnav.simulation.body import body_motion

TICK_S, FRAME_TICKS = 0.02, 3
VIEW_M, VIEW_HALF_M = (0.85, 1.75), 0.95
LENGTH_M = 6.0
SHAKE_RAD, SHAKE_HZ = radians(1), 1.4
SIDESLIP = 0.009
"""A 2 degree side slope on loose soil."""
FIRST_LOOK_M, FIRST_LOOK_RAD = 0.02, radians(1.5)
ROBOT = load_robot("bonnbot")
STARTS = ((0.25, 0.0), (0.25, 15.0), (-0.25, 15.0), (0.0, -15.0))
USUAL = ("sugar-beet", "winter-wheat")
"""Far and near rows; the other crops lie between them."""
CROPS = tuple(
    name if name in USUAL else pytest.param(name, marks=pytest.mark.long) for name in names_of(Kind.CROP)
)


@dataclass(frozen=True)
class Drive:
    """What a drive was like: s, offset and heading over it, and the wheels' tracks across the lane."""

    s_m: np.ndarray
    offset_m: np.ndarray
    heading_rad: np.ndarray
    wheels_m: np.ndarray


def drive(
    crop: CropProfile,
    control: Control,
    start: tuple[float, float],
    speed_mps: float,
    latency_s: float,
    seed: int,
) -> Drive:
    """Drive LENGTH_M from an offset in m and a heading in degrees against a straight lane along x."""
    random = np.random.default_rng(seed)
    plants = stand(crop, random)
    true, reckoned = Pose(0.0, start[0], radians(start[1])), Pose()
    motors = {wheel: SimulatedMotion() for wheel in Wheel}
    speed_error = {wheel: 1 + random.uniform(-0.02, 0.02) for wheel in Wheel}
    zero_rad = {wheel: radians(random.uniform(-0.5, 0.5)) for wheel in Wheel}
    path = first_look(crop, true, random)
    waiting: deque[tuple[float, Sighting, Pose]] = deque()
    motion, told, phase, rows = Motion(), STANDSTILL, random.uniform(0, 2 * np.pi), []
    for tick in range(round((LENGTH_M / speed_mps + 2) / TICK_S)):
        now_s = tick * TICK_S
        if tick % FRAME_TICKS == 0:
            roll = SHAKE_RAD * np.sqrt(2) * sin(2 * np.pi * SHAKE_HZ * now_s + phase)
            waiting.append((now_s + latency_s, seen(crop, plants, true, roll), reckoned))
        while waiting and waiting[0][0] <= now_s:
            _, sighting, pose = waiting.popleft()
            path.carry(pose)
            path.see(sighting)
        motion = limit(follow_path(path.state(reckoned), speed_mps, control), told, TICK_S, ROBOT.limits)
        told = motion.twist
        present = {wheel: motor.steering_rad for wheel, motor in motors.items()}
        wanted = wheel_setpoints(motion, ROBOT.geometry, present, ROBOT.limits)
        for wheel, motor in motors.items():
            motor.advance(TICK_S, wanted[wheel].speed_mps, wanted[wheel].steering_rad)
        said = {w: WheelSetpoint(m.speed_mps, m.steering_rad) for w, m in motors.items()}
        truly = {
            w: WheelSetpoint(m.speed_mps * speed_error[w], m.steering_rad + zero_rad[w])
            for w, m in motors.items()
        }
        reckoned = reckoned.moved(body_twist(said, ROBOT.geometry), TICK_S)
        moved = body_motion(truly, ROBOT.geometry, 0.02)
        pushed = Twist(moved.vx_mps, moved.vy_mps + SIDESLIP * moved.vx_mps, moved.yaw_rate_rps)
        true = true.moved(pushed, TICK_S)
        rows.append((true.x_m, true.y_m, true.heading_rad, *wheels_aside(true)))
    table = np.array(rows)
    return Drive(table[:, 0], table[:, 1], table[:, 2], table[:, 3:])


def stand(crop: CropProfile, random: np.random.Generator) -> np.ndarray:
    """Plants of one lane along x, shape (n, 2)."""
    along = np.arange(-1.0, LENGTH_M + 4, crop.plants.spacing_m)
    places = [np.stack([along, np.full(len(along), y)], axis=-1) for y in comb_m(crop)]
    plants = np.concatenate(places)
    return plants + random.normal(0, [0.01, 0.015], plants.shape)


def seen(crop: CropProfile, plants: np.ndarray, true: Pose, roll_rad: float) -> Sighting:
    c, s = cos(true.heading_rad), sin(true.heading_rad)
    beside = (plants - [true.x_m, true.y_m]) @ np.array([[c, -s], [s, c]]) + [0.0, tan(roll_rad)]
    inside = (beside[:, 0] > VIEW_M[0]) & (beside[:, 0] < VIEW_M[1]) & (np.abs(beside[:, 1]) < VIEW_HALF_M)
    points = beside[inside]
    reach = min(crop.plants.canopy_width_m / 2 + 0.02, widest_m(crop))
    return Sighting(points, np.full(len(points), reach), np.ones(len(points)))


def first_look(crop: CropProfile, true: Pose, random: np.random.Generator) -> LanePath:
    """What Acquiring would tell, with the errors of a first look."""
    slope = -tan(true.heading_rad + random.uniform(-1, 1) * FIRST_LOOK_RAD)
    middle_m = sum(VIEW_M) / 2
    there_m = -(true.y_m + middle_m * sin(true.heading_rad)) / cos(true.heading_rad)
    offset_m = there_m + random.uniform(-1, 1) * FIRST_LOOK_M - slope * middle_m
    return LanePath(Pose(), offset_m, slope, comb_m(crop), scatter_m(crop), VIEW_M[1])


def wheels_aside(true: Pose) -> list[float]:
    """Where the wheels' middles are across the lane, shape (4,)."""
    places = (ROBOT.geometry.position_m(wheel) for wheel in Wheel)
    return [true.y_m + x * sin(true.heading_rad) + y * cos(true.heading_rad) for x, y in places]


def touching(driven: Drive, crop: CropProfile) -> np.ndarray:
    """Which wheel stands on which row at each tick, shape (ticks, wheels, rows)."""
    off = driven.wheels_m[:, :, None] - comb_m(crop)
    return np.abs(off) < ROBOT.geometry.wheel_width_m / 2 + 0.01


@pytest.mark.parametrize("latency_s", [0.0, 0.2])
@pytest.mark.parametrize("speed_mps", [0.2, 0.5, 1.0])
@pytest.mark.parametrize("crop_name", CROPS)
def test_from_anywhere_near_the_lane_the_robot_comes_onto_it_without_touching_a_row(
    crop_name: str, speed_mps: float, latency_s: float
) -> None:
    crop = load_crop(crop_name)
    for seed, start in enumerate(STARTS if latency_s else STARTS[:1]):
        driven = drive(crop, crop.control, start, speed_mps, latency_s, seed)
        case = f"start {start}, seed {seed}"
        came_m = driven.s_m[-1]
        last = driven.s_m > came_m - 2
        assert came_m > LENGTH_M * 0.8, case
        assert np.abs(driven.offset_m[last]).max() < 0.03, case
        assert np.abs(np.degrees(driven.heading_rad[last])).max() < 2.0, case
        overshoot_m = -np.sign(start[0]) * driven.offset_m if start[0] else np.abs(driven.offset_m) - 0.1
        assert overshoot_m.max() < 0.05, case
        # Set down askew a wheel may stand on a row; it leaves it and comes onto none that it was not on.
        on = touching(driven, crop)
        assert not (on & ~on[0]).any(), case
        assert not on[driven.s_m > 1.5].any(), case


@pytest.mark.parametrize("speed_mps", [0.2, 0.5, 1.0])
def test_wheels_held_straight_come_onto_the_lane_too(speed_mps: float) -> None:
    crop = load_crop("sugar-beet")
    control = crop.control.model_copy(update={"steering": Steering.DIFFERENTIAL})
    for seed, start in enumerate(((0.15, 0.0), (0.0, 10.0), (-0.15, 5.0))):
        driven = drive(crop, control, start, speed_mps, 0.2, seed)
        last = driven.s_m > driven.s_m[-1] - 1
        assert np.abs(driven.offset_m[last]).max() < 0.04, f"start {start}"
        assert np.abs(np.degrees(driven.heading_rad[last])).max() < 3.0, f"start {start}"
        assert degrees(SIDESLIP) < 1
