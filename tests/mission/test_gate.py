from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, inf, nan, pi, radians

import can
import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.errors import DriverError
from fieldnav.messages import STANDSTILL, Motion, Steering, Twist, Wheel, WheelReport
from fieldnav.mission.gate import Gate
from fieldnav.mission.refusal import Sight
from fieldnav.settings.camera import Cameras, CameraSettings
from fieldnav.settings.robot import Bus, Geometry, Limits, Module, Robot

TICK_S = 0.02
FRESH_S = 0.05
AHEAD = Motion(Twist(0.5))
SIDEWAYS = Motion(Twist(0.0, 0.15), Steering.OMNIDIRECTIONAL)
FL = Wheel.FRONT_LEFT


@pytest.fixture
def robot() -> Robot:
    camera = CameraSettings(
        source="none",
        width_px=640,
        height_px=360,
        rate_hz=15,
        horizontal_fov_deg=69,
        height_m=1.0,
        tilt_deg=65,
        distance_m=0.75,
    )
    return Robot(
        name="test-robot",
        geometry=Geometry(track_m=1.4, wheelbase_m=1.0, length_m=1.4, clearance_m=0.86),
        modules={wheel: Module(node_id=node) for node, wheel in enumerate(Wheel, start=1)},
        cameras=Cameras(front=camera, rear=camera),
        can=Bus(interface="virtual", channel="test"),
        limits=Limits(speed_mps=1.0),
    )


class Rig:
    """Gate, driver, bus and simulated modules, ticked together on simulated time."""

    def __init__(self, robot: Robot) -> None:
        self.host, self.far = open_virtual_pair()
        self.tap = can.interfaces.virtual.VirtualBus(self.host.channel_id, preserve_timestamps=True)
        self.wheels = ThorvaldWheels(robot, self.host)
        self.modules = SimulatedModules(robot, self.far, can_delay_s=0.005)
        self.gate = Gate(self.wheels, robot)
        self.now_s = 0.0
        self.wheels.start(0.0)
        self.run(0.3, Motion(), moving=False)
        assert self.wheels.ready

    def tick(self, motion: Motion, moving: bool = True, age_s: float | None = FRESH_S):
        self.now_s = round(self.now_s + TICK_S, 6)
        self.modules.step(self.now_s)
        self.report = self.wheels.poll(self.now_s)
        return self.gate.pass_on(self.now_s, motion, moving, Sight(age_s), self.report)

    def run(self, seconds: float, motion: Motion, **options):
        return [self.tick(motion, **options) for _ in range(round(seconds / TICK_S))]

    def sent_speeds(self) -> set[float]:
        """Drive speeds on the bus since the last call, per mille."""
        speeds = set()
        while (frame := self.tap.recv(timeout=0)) is not None:
            telegram = wire_layout().read(frame)
            if telegram and telegram.kind is Kind.DRIVE:
                speeds.add(telegram.values["DriveSpeed"])
        return speeds

    def close(self) -> None:
        for bus in (self.host, self.far, self.tap):
            bus.shutdown()

    @property
    def true_speed_mps(self) -> float:
        return max(abs(state.speed_mps) for state in self.modules.wheel_states().values())


@pytest.fixture
def rig(robot) -> Iterator[Rig]:
    rig = Rig(robot)
    yield rig
    rig.close()


def test_a_wanted_speed_is_reached_within_the_acceleration_limit(rig):
    passed = rig.run(1.0, AHEAD)

    speeds = [one.motion.twist.vx_mps for one in passed]
    assert max(after - before for before, after in zip([0.0, *speeds], speeds, strict=False)) <= 0.016 + 1e-9
    assert speeds[-1] == 0.5
    assert {one.reason for one in passed} == {""}
    assert rig.true_speed_mps == pytest.approx(0.5, abs=0.001)


@pytest.mark.parametrize("motion", [AHEAD, SIDEWAYS, Motion(Twist(0.3, 0.3, 0.3), Steering.OMNIDIRECTIONAL)])
def test_outside_moving_states_zero_is_sent_from_the_first_round_on(rig, motion):
    rig.run(3.0, motion)
    turned = {wheel: state.steering_rad for wheel, state in rig.modules.wheel_states().items()}
    rig.sent_speeds()

    passed = rig.run(1.0, motion, moving=False)

    assert rig.sent_speeds() == {0}
    assert {one.motion.twist for one in passed} == {STANDSTILL}
    assert {one.reason for one in passed} == {""}
    assert rig.true_speed_mps == 0.0
    for wheel, state in rig.modules.wheel_states().items():
        assert state.steering_rad == pytest.approx(turned[wheel], abs=0.01), "the wheels stay as they are"


@pytest.mark.parametrize("motion", [AHEAD, SIDEWAYS, Motion(Twist(0.3, 0.3, 0.3), Steering.OMNIDIRECTIONAL)])
@pytest.mark.parametrize("age_s", [None, 0.51, 99.0, nan, inf])
def test_a_stale_frame_sends_zero_at_once_and_says_why(rig, motion, age_s):
    rig.run(2.0, motion)
    rig.sent_speeds()

    passed = rig.tick(motion, age_s=age_s)

    assert rig.sent_speeds() == {0}
    assert passed.motion.twist == STANDSTILL
    assert passed.refused is not None
    assert "limit 0.50 s" in passed.reason
    assert (
        "no frame has come yet" in passed.reason if age_s is None else f"{age_s:.2f} s old" in passed.reason
    )


def test_a_frame_within_its_age_passes(rig):
    assert rig.tick(AHEAD, age_s=0.5).reason == ""


@pytest.mark.parametrize("ahead_s", [0.021, 0.5, 100.0, inf])
def test_a_frame_from_the_future_sends_zero_at_once_and_says_by_how_much(rig, ahead_s):
    rig.run(1.0, AHEAD)
    rig.sent_speeds()

    passed = rig.tick(AHEAD, age_s=-ahead_s)

    assert rig.sent_speeds() == {0}
    assert passed.motion.twist == STANDSTILL
    assert (
        passed.reason == f"frames late: newest frame is stamped {ahead_s:.2f} s in the future, limit 0.02 s"
    )


def test_a_frame_that_comes_within_its_tick_passes(rig):
    assert rig.tick(AHEAD, age_s=-0.02).reason == ""


@pytest.mark.parametrize(
    ("stamp_s", "said"),
    [(3.0, "1.00 s in the future"), (inf, "inf s in the future"), (nan, "nan s ago"), (-inf, "inf s ago")],
)
def test_a_report_whose_stamp_is_no_past_time_stops_all(rig, stamp_s, said):
    rig.run(1.66, AHEAD)
    rig.tick(AHEAD)
    rig.sent_speeds()
    odd = replace(rig.report.modules[FL], stamp_s=stamp_s)
    report = WheelReport(
        {**{wheel: replace(module, stamp_s=2.0) for wheel, module in rig.report.modules.items()}, FL: odd}
    )

    passed = rig.gate.pass_on(2.0, AHEAD, True, Sight(FRESH_S), report)

    assert rig.sent_speeds() == {0}
    assert passed.refused is not None
    assert passed.reason.startswith(f"module late: module front_left last reported {said}, limit")


def test_the_mode_changes_only_while_every_wheel_reports_less_than_two_centimetres_a_second(rig):
    def mode_at(speed_mps):
        slow = {wheel: replace(said, speed_mps=0.0) for wheel, said in rig.report.modules.items()}
        report = WheelReport({**slow, FL: replace(slow[FL], speed_mps=speed_mps)})
        return rig.gate.pass_on(rig.now_s, SIDEWAYS, True, Sight(FRESH_S), report).motion.steering

    assert mode_at(-0.021) is Steering.DIFFERENTIAL
    assert mode_at(nan) is Steering.DIFFERENTIAL
    assert mode_at(0.019) is Steering.OMNIDIRECTIONAL


@pytest.mark.parametrize("broken", [nan, inf, -inf])
@pytest.mark.parametrize("place", range(3))
def test_a_twist_that_is_not_finite_sends_zero_at_once_and_says_why(rig, broken, place):
    rig.run(1.0, AHEAD)
    rig.sent_speeds()
    numbers = [0.1, 0.0, 0.0]
    numbers[place] = broken

    passed = rig.tick(Motion(Twist(*numbers)))

    assert rig.sent_speeds() == {0}
    assert passed.refused is not None
    assert "not finite" in passed.reason


def test_a_module_with_a_fault_stops_all_and_is_named_with_its_fault(rig):
    rig.run(1.0, AHEAD)
    rig.modules.modules[FL].undervoltage = True
    rig.run(0.2, AHEAD)
    rig.sent_speeds()

    passed = rig.tick(AHEAD)

    said = "module front_left (node 3): controller not healthy, undervoltage, EMCY 3120 (voltage)"
    assert passed.reason == f"module unhealthy: {said}"
    assert rig.sent_speeds() == {0}


def test_a_report_that_is_too_old_or_missing_stops_all(rig):
    rig.run(1.0, AHEAD)
    old = rig.report
    rig.run(2.2, AHEAD)

    stale = rig.gate.pass_on(rig.now_s, AHEAD, True, Sight(FRESH_S), old)
    missing = rig.gate.pass_on(rig.now_s, AHEAD, True, Sight(FRESH_S), WheelReport())

    assert stale.refused is not None
    assert "last reported 2.2" in stale.reason
    assert "limit 0.20 s" in stale.reason
    assert stale.motion.twist == STANDSTILL
    assert missing.reason == "module late: module rear_right has not reported"
    assert missing.setpoints == {}


def test_a_silent_bus_outside_moving_states_is_zero_at_once(rig):
    rig.run(1.0, AHEAD)
    rig.sent_speeds()

    rig.gate.pass_on(rig.now_s + TICK_S, AHEAD, False, Sight(None), WheelReport())

    assert rig.sent_speeds() == {0}


def test_wheels_turn_before_the_robot_moves_sideways(rig):
    hold = Motion(SIDEWAYS.twist, SIDEWAYS.steering, hold=True)

    for passed in rig.run(1.5, hold):
        assert all(setpoint.speed_mps == 0 for setpoint in passed.setpoints.values())
    assert rig.gate.aligned
    assert all(abs(state.steering_rad - pi / 2) < 0.01 for state in rig.modules.wheel_states().values())
    rig.run(1.0, SIDEWAYS)

    assert rig.true_speed_mps == pytest.approx(0.15, abs=0.001)


def test_even_without_a_hold_nothing_moves_before_the_wheels_are_turned(rig):
    moved_at = None
    for _ in range(100):
        rig.tick(SIDEWAYS)
        worst = max(abs(state.steering_rad - pi / 2) for state in rig.modules.wheel_states().values())
        if moved_at is None and rig.true_speed_mps > 0:
            moved_at = worst
            assert rig.gate.aligned

    assert moved_at is not None
    assert moved_at < radians(4)
    assert rig.true_speed_mps == pytest.approx(0.15, abs=0.001)


def test_set_points_never_turn_faster_than_the_steering_rate(rig, robot):
    angles = []
    for motion in (AHEAD, SIDEWAYS, AHEAD, Motion(Twist(0.0, 0.0, 0.3), Steering.OMNIDIRECTIONAL)):
        angles += [one.setpoints[FL].steering_rad for one in rig.run(2.0, motion)]

    steps = [abs(after - before) for before, after in pairwise(angles)]
    # After a rest the set-point begins anew from the reported angle: one step on the wire, 3 mrad.
    assert max(steps) <= robot.limits.steering_rate_rps * TICK_S + 0.004
    assert max(angles) > 1.5


def test_with_a_stuck_wheel_the_speed_is_the_cosine_of_its_error(rig):
    diagonal = Motion(Twist(0.2, 0.0), Steering.OMNIDIRECTIONAL)
    rig.run(1.0, diagonal)
    rig.modules.modules[FL].steering_stuck = True

    passed = rig.run(3.0, Motion(Twist(0.2 * cos(0.8), 0.2 * cos(pi / 2 - 0.8)), Steering.OMNIDIRECTIONAL))[
        -1
    ]

    assert not rig.gate.aligned
    twist = passed.motion.twist
    assert hypot(twist.vx_mps, twist.vy_mps) == pytest.approx(0.2 * cos(0.8), abs=0.002)


def test_the_steering_mode_changes_only_at_standstill(rig):
    rig.run(1.0, AHEAD)

    for _ in range(100):
        passed = rig.tick(SIDEWAYS)
        if rig.true_speed_mps > 0.03 and rig.now_s < 2.5:
            assert passed.motion.steering is Steering.DIFFERENTIAL
            assert all(setpoint.steering_rad == 0 for setpoint in passed.setpoints.values())

    assert passed.motion.steering is Steering.OMNIDIRECTIONAL


def test_after_sideways_the_wheels_are_straight_before_the_robot_goes_on(rig):
    rig.run(3.0, SIDEWAYS)

    for _ in range(200):
        rig.tick(Motion(Twist(-0.5)))
        states = rig.modules.wheel_states().values()
        if rig.true_speed_mps > 0.16:
            assert max(abs(state.steering_rad) for state in states) < radians(4)

    assert rig.true_speed_mps == pytest.approx(0.5, abs=0.001)


def test_no_wheel_is_asked_for_more_than_its_module_can_do(robot):
    slow = robot.modules[FL].model_copy(update={"motor_max_rpm": 500.0})
    rig = Rig(robot.model_copy(update={"modules": {**robot.modules, FL: slow}}))

    passed = rig.run(2.0, Motion(Twist(0.9, 0.0, 0.2)))[-1]

    assert max(abs(setpoint.speed_mps) for setpoint in passed.setpoints.values()) <= slow.top_speed_mps + 1e-9
    rig.close()


def test_a_late_tick_does_not_make_up_for_the_time_it_lost(rig):
    rig.tick(AHEAD)
    before_mps = rig.tick(AHEAD).motion.twist.vx_mps
    rig.now_s += 1.0

    after_mps = rig.tick(AHEAD).motion.twist.vx_mps

    assert after_mps - before_mps <= 0.8 * 0.1 + 1e-9


def test_a_gone_bus_is_a_driver_error(rig):
    rig.wheels.close()

    with pytest.raises(DriverError):
        rig.gate.pass_on(1.0, AHEAD, True, Sight(FRESH_S), rig.report)


def test_when_the_host_dies_the_wheels_stop_by_the_watchdog_and_their_ramp(rig):
    rig.run(1.0, AHEAD)

    rig.modules.step(rig.now_s + 0.2 + 0.5 / 1.5 + 0.02)

    assert rig.true_speed_mps == 0


def test_a_mirrored_drive_is_mirrored(robot):
    def drive(sign):
        rig = Rig(robot)
        speeds = []
        for motion in (
            Motion(Twist(0.5, 0.0, 0.1 * sign)),
            Motion(Twist(0.05, 0.15 * sign, 0.02 * sign), Steering.OMNIDIRECTIONAL),
        ):
            speeds += [one.motion.twist for one in rig.run(2.0, motion)]
        rig.close()
        return speeds

    for left, right in zip(drive(1), drive(-1), strict=True):
        assert (left.vx_mps, left.vy_mps, left.yaw_rate_rps) == (
            right.vx_mps,
            -right.vy_mps,
            -right.yaw_rate_rps,
        )
