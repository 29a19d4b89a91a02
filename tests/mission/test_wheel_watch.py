"""A wheel that does not do what it is told is noticed soon; one that does, at its limits, is left alone."""

from collections import deque
from collections.abc import Mapping
from math import radians

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.simulated_motion import SimulatedMotion
from fieldnav.control.kinematics import wheel_setpoints
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import ModuleReport, Motion, Steering, Twist, Wheel, WheelReport, WheelSetpoint
from fieldnav.mission.drive_watch import RUNAWAY_MPS, RUNAWAY_S
from fieldnav.mission.gate import Passed
from fieldnav.mission.loop import TICK_S
from fieldnav.mission.wheel_watch import FAR_S, OFF_S, WheelWatch
from fieldnav.settings.loading import load_robot

ROBOT = load_robot("bonnbot")
LIMITS = ROBOT.limits
ALIGNED_RAD = radians(LIMITS.steering_aligned_deg)
STEP_S = 0.005
DELAY_STEPS = 5
"""Of a command and of a report together, 25 ms: more than the bus takes."""
TOP_MPS, TURNED_RAD = LIMITS.speed_mps, radians(90)


Told = Mapping[Wheel, WheelSetpoint]


class Robot:
    """Four modules, watched over; what is broken is broken by hand."""

    def __init__(self) -> None:
        self.watch, self.now_s = WheelWatch(ALIGNED_RAD, ROBOT.geometry), 0.0
        self.modules = {wheel: SimulatedMotion() for wheel in Wheel}
        self.driven_m = 0.0
        standing = dict.fromkeys(Wheel, WheelSetpoint(0.0, 0.0))
        self.waiting: deque[Told] = deque([standing] * DELAY_STEPS)
        self.shares = dict.fromkeys(Wheel, 1.0)
        self.stuck: Wheel | None = None
        self.runaway: tuple[Wheel, float] | None = None
        self.muted_at_s: float | None = None
        self._last: dict[Wheel, ModuleReport] = {}

    def round(self, told: WheelSetpoint | Told) -> Trouble | None:
        """Let a round of the loop pass, all wheels told alike or each its own; what the watch then says."""
        told = dict.fromkeys(Wheel, told) if isinstance(told, WheelSetpoint) else told
        self.watch.sent(self.now_s, Passed(Motion(), told))
        for _ in range(round(TICK_S / STEP_S)):
            self.waiting.append(told)
            obeyed = self.waiting.popleft()
            for wheel, motion in self.modules.items():
                self._move(wheel, motion, obeyed[wheel])
            self.driven_m += STEP_S * sum(abs(point.speed_mps) for point in obeyed.values()) / len(Wheel)
        self.now_s += TICK_S
        return self.watch.trouble(self.now_s, WheelReport(self._reports()))

    def run(
        self, seconds: float, told: WheelSetpoint | Told, ignored: FaultKind | None = None
    ) -> Trouble | None:
        """The first trouble within a time, None without any but what is ignored."""
        for _ in range(round(seconds / TICK_S)):
            trouble = self.round(told)
            if trouble is not None and trouble.fault is not ignored:
                return trouble
        return None

    def _move(self, wheel: Wheel, motion: SimulatedMotion, told: WheelSetpoint) -> None:
        runs = self.runaway is not None and self.runaway[0] is wheel
        speed_mps = self.runaway[1] if self.runaway and runs else told.speed_mps * self.shares[wheel]
        motion.advance(STEP_S, speed_mps, None if self.stuck is wheel else told.steering_rad)

    def _reports(self) -> dict[Wheel, ModuleReport]:
        for wheel, motion in self.modules.items():
            muted = wheel is Wheel.FRONT_LEFT and self.muted_at_s is not None
            if not muted:
                self._last[wheel] = ModuleReport(self.now_s, motion.speed_mps, motion.steering_rad)
        return self._last


class Gated:
    """Set-points within what the gate lets through: speed ramps, steering rate, and zero at any moment."""

    def __init__(self) -> None:
        self.speed_mps = self.steering_rad = 0.0

    def towards(self, speed_mps: float, steering_rad: float) -> WheelSetpoint:
        ramp_mps, turn_rad = LIMITS.acceleration_mps2 * TICK_S, LIMITS.steering_rate_rps * TICK_S
        self.speed_mps += max(-ramp_mps, min(ramp_mps, speed_mps - self.speed_mps))
        self.steering_rad += max(-turn_rad, min(turn_rad, steering_rad - self.steering_rad))
        return WheelSetpoint(self.speed_mps, self.steering_rad)

    def halt(self) -> WheelSetpoint:
        self.speed_mps = 0.0
        return WheelSetpoint(0.0, self.steering_rad)


Leg = tuple[float, float, float, bool]
LEGS = st.lists(
    st.tuples(
        st.floats(-TOP_MPS, TOP_MPS), st.floats(-TURNED_RAD, TURNED_RAD), st.floats(0.1, 1.5), st.booleans()
    ),
    min_size=1,
    max_size=4,
)


@settings(max_examples=60, deadline=None)
@given(LEGS)
def test_healthy_wheels_at_their_limits_are_left_alone(legs: list[Leg]) -> None:
    robot, gate = Robot(), Gated()
    for speed_mps, steering_rad, seconds, halts in legs:
        for _ in range(round(seconds / TICK_S)):
            assert robot.round(gate.towards(speed_mps, steering_rad)) is None
        if halts:
            assert robot.round(gate.halt()) is None


@pytest.mark.parametrize("told_rad", [radians(15), radians(-90)])
def test_a_stuck_wheel_is_noticed_within_a_second(told_rad: float) -> None:
    robot = Robot()
    robot.stuck = Wheel.REAR_RIGHT
    trouble = robot.run(FAR_S + 0.2, WheelSetpoint(0.0, told_rad))
    assert trouble is not None
    assert trouble.fault is FaultKind.STEERING_STUCK
    assert "rear_right" in trouble.said


@pytest.mark.parametrize("off_rad", [ALIGNED_RAD, radians(7), radians(-10)])
def test_a_wheel_that_is_a_little_off_is_noticed_only_after_longer(off_rad: float) -> None:
    robot = Robot()
    robot.stuck = Wheel.REAR_RIGHT
    told = WheelSetpoint(0.3, off_rad)
    assert robot.run(OFF_S - 0.2, told) is None
    trouble = robot.run(0.4, told)
    assert trouble is not None
    assert trouble.fault is FaultKind.STEERING_STUCK


@pytest.mark.parametrize("runs_mps", [1.0, -1.0])
@pytest.mark.parametrize("told_mps", [0.0, 0.5])
def test_a_wheel_that_runs_away_is_noticed_in_either_direction(told_mps: float, runs_mps: float) -> None:
    robot = Robot()
    assert robot.run(1.0, WheelSetpoint(told_mps, 0.0)) is None
    robot.runaway = Wheel.FRONT_RIGHT, runs_mps
    trouble = robot.run(1.5, WheelSetpoint(told_mps, 0.0))
    assert trouble is not None
    if trouble.fault is FaultKind.DRIVE_WEAK:  # on its way it is slow at first; the robot is then stopped
        trouble = robot.run(1.5, WheelSetpoint(0.0, 0.0), ignored=FaultKind.DRIVE_WEAK)
    assert trouble is not None
    assert trouble.fault is FaultKind.DRIVE_RUNAWAY
    assert "front_right" in trouble.said


def test_a_wheel_at_rest_that_runs_away_is_noticed_within_a_third_of_a_second() -> None:
    robot = Robot()
    robot.run(0.5, WheelSetpoint(0.0, 0.0))
    robot.runaway, began_s = (Wheel.FRONT_RIGHT, 1.0), robot.now_s
    assert robot.run(1.0, WheelSetpoint(0.0, 0.0)) is not None
    assert robot.now_s - began_s < RUNAWAY_S + RUNAWAY_MPS + 0.05


def test_a_wheel_that_is_slower_than_told_does_not_run_away() -> None:
    robot = Robot()
    robot.runaway = Wheel.FRONT_RIGHT, 0.0
    assert robot.run(3.0, WheelSetpoint(0.5, 0.0), ignored=FaultKind.DRIVE_WEAK) is None


def test_a_wheel_that_goes_on_when_told_to_stop_is_noticed() -> None:
    robot = Robot()
    robot.run(1.5, WheelSetpoint(0.5, 0.0))
    robot.runaway = Wheel.REAR_LEFT, 0.5
    trouble = robot.run(1.5, WheelSetpoint(0.0, 0.0))
    assert trouble is not None
    assert trouble.fault is FaultKind.DRIVE_RUNAWAY


def test_a_module_that_reports_late_does_not_run_away() -> None:
    robot = Robot()
    robot.run(1.5, WheelSetpoint(0.5, 0.0))
    robot.muted_at_s = robot.now_s
    assert robot.run(2.0, WheelSetpoint(0.0, 0.0)) is None, "its last word is no word on what it does now"


def test_a_wheel_is_watched_again_once_it_reports_again() -> None:
    robot = Robot()
    robot.run(1.0, WheelSetpoint(0.5, 0.0))
    robot.muted_at_s = robot.now_s
    robot.run(0.5, WheelSetpoint(0.0, 0.0))
    robot.muted_at_s, robot.runaway = None, (Wheel.FRONT_LEFT, 1.0)
    assert robot.run(1.5, WheelSetpoint(0.0, 0.0)) is not None


def test_what_was_told_before_somebody_else_took_over_is_forgotten() -> None:
    robot = Robot()
    robot.run(1.0, WheelSetpoint(0.0, radians(80)))
    robot.watch.forget()
    assert robot.watch.trouble(robot.now_s, WheelReport(robot._reports())) is None
    robot.watch.sent(robot.now_s, Passed(Motion(), {}))
    assert robot.watch.trouble(robot.now_s, WheelReport(robot._reports())) is None


MOTIONS = {
    "ahead": Motion(Twist(0.5, 0.0, 0.0)),
    "back": Motion(Twist(-0.5, 0.0, 0.0)),
    "at a crawl": Motion(Twist(0.05, 0.0, 0.0)),
    "sideways": Motion(Twist(0.0, -0.15, 0.0), Steering.OMNIDIRECTIONAL),
    "in a curve of 10 m": Motion(Twist(0.5, 0.0, 0.05)),
    "crabwise": Motion(Twist(0.3, 0.05, 0.05), Steering.OMNIDIRECTIONAL),
}
FOUND_WITHIN_M = 0.45
"""Less than half a metre, from the moment on in which the drive gives way."""


def told_for(motion: Motion) -> Told:
    return wheel_setpoints(motion, ROBOT.geometry, {}, LIMITS)


@pytest.mark.parametrize("share", [0.0, 0.6, 1.4])
@pytest.mark.parametrize("weak", Wheel)
@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_a_drive_that_does_not_follow_is_found_within_half_a_metre(
    motion: Motion, weak: Wheel, share: float
) -> None:
    robot, told = Robot(), told_for(motion)
    assert robot.run(2.0, told) is None
    robot.shares[weak], robot.driven_m = share, 0.0
    trouble = robot.run(20.0, told)
    assert trouble is not None
    allowed = {FaultKind.DRIVE_WEAK, FaultKind.DRIVE_RUNAWAY} if share > 1 else {FaultKind.DRIVE_WEAK}
    assert trouble.fault in allowed
    assert f"module {weak.value} drives at" in trouble.said
    assert robot.driven_m < FOUND_WITHIN_M


def test_a_drive_that_is_dead_from_the_start_is_found_before_the_robot_is_fast() -> None:
    robot, gate = Robot(), Gated()
    robot.shares[Wheel.REAR_LEFT] = 0.0
    while robot.round(gate.towards(0.5, 0.0)) is None:
        assert robot.now_s < 1.0
    assert robot.driven_m < 0.2


@pytest.mark.parametrize("side", [(Wheel.FRONT_LEFT, Wheel.REAR_LEFT), (Wheel.FRONT_LEFT, Wheel.REAR_RIGHT)])
def test_two_drives_on_one_fuse_are_found_like_one(side: tuple[Wheel, Wheel]) -> None:
    robot, told = Robot(), told_for(MOTIONS["ahead"])
    robot.run(2.0, told)
    robot.shares |= dict.fromkeys(side, 0.6)
    robot.driven_m = 0.0
    trouble = robot.run(5.0, told)
    assert trouble is not None
    assert any(f"module {wheel.value} drives" in trouble.said for wheel in side)
    assert robot.driven_m < FOUND_WITHIN_M


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_ground_that_slows_all_wheels_alike_is_no_fault_of_a_drive(motion: Motion) -> None:
    robot = Robot()
    robot.shares = dict.fromkeys(Wheel, 0.5)
    assert robot.run(20.0, told_for(motion)) is None


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_drives_that_keep_within_a_tenth_are_left_alone(motion: Motion) -> None:
    robot = Robot()
    robot.shares = dict(zip(Wheel, (0.9, 1.1, 1.0, 0.95), strict=True))
    assert robot.run(20.0, told_for(motion)) is None


def test_a_wheel_that_slips_back_for_a_moment_is_left_alone() -> None:
    robot, told = Robot(), told_for(MOTIONS["ahead"])
    robot.run(2.0, told)
    for _ in range(10):
        robot.shares[Wheel.FRONT_LEFT] = 0.6
        assert robot.run(0.2, told) is None
        robot.shares[Wheel.FRONT_LEFT] = 1.0
        assert robot.run(0.8, told) is None


def test_a_drive_that_is_told_nothing_is_not_weak() -> None:
    robot = Robot()
    robot.shares = dict.fromkeys(Wheel, 0.0)
    assert robot.run(20.0, WheelSetpoint(0.0, 0.5)) is None


def test_after_another_has_driven_a_drive_has_its_whole_way_before_it_again() -> None:
    robot, told = Robot(), told_for(MOTIONS["ahead"])
    robot.run(2.0, told)
    robot.shares[Wheel.FRONT_LEFT] = 0.6
    robot.run(0.5, told)
    robot.watch.forget()
    assert robot.run(0.4, told) is None
