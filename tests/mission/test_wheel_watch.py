"""A wheel that does not do what it is told is noticed soon; one that does, at its limits, is left alone."""

from collections import deque
from math import radians

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.simulated_motion import SimulatedMotion
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import ModuleReport, Motion, Wheel, WheelReport, WheelSetpoint
from fieldnav.mission.gate import Passed
from fieldnav.mission.loop import TICK_S
from fieldnav.mission.wheel_watch import FAR_S, OFF_S, RUNAWAY_MPS, RUNAWAY_S, WheelWatch
from fieldnav.settings.loading import load_robot

LIMITS = load_robot("bonnbot").limits
ALIGNED_RAD = radians(LIMITS.steering_aligned_deg)
STEP_S = 0.005
DELAY_STEPS = 5
"""Of a command and of a report together, 25 ms: more than the bus takes."""
TOP_MPS, TURNED_RAD = LIMITS.speed_mps, radians(90)


class Robot:
    """Four modules that are told alike, watched over; what is broken is broken by hand."""

    def __init__(self) -> None:
        self.watch, self.now_s = WheelWatch(ALIGNED_RAD), 0.0
        self.modules = {wheel: SimulatedMotion() for wheel in Wheel}
        self.waiting: deque[WheelSetpoint] = deque([WheelSetpoint(0.0, 0.0)] * DELAY_STEPS)
        self.stuck: Wheel | None = None
        self.runaway: tuple[Wheel, float] | None = None
        self.muted_at_s: float | None = None
        self._last: dict[Wheel, ModuleReport] = {}

    def round(self, told: WheelSetpoint) -> Trouble | None:
        """Let a round of the loop pass; what the watch says at its end."""
        self.watch.sent(self.now_s, Passed(Motion(), dict.fromkeys(Wheel, told)))
        for _ in range(round(TICK_S / STEP_S)):
            self.waiting.append(told)
            obeyed = self.waiting.popleft()
            for wheel, motion in self.modules.items():
                self._move(wheel, motion, obeyed)
        self.now_s += TICK_S
        return self.watch.trouble(self.now_s, WheelReport(self._reports()))

    def run(self, seconds: float, told: WheelSetpoint) -> Trouble | None:
        """The first trouble within a time, None without any."""
        for _ in range(round(seconds / TICK_S)):
            trouble = self.round(told)
            if trouble is not None:
                return trouble
        return None

    def _move(self, wheel: Wheel, motion: SimulatedMotion, told: WheelSetpoint) -> None:
        runs = self.runaway is not None and self.runaway[0] is wheel
        speed_mps = self.runaway[1] if self.runaway and runs else told.speed_mps
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
    assert robot.run(3.0, WheelSetpoint(0.5, 0.0)) is None


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
