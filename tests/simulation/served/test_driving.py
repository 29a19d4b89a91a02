"""The served robot as a host drives it: python-can's socketcand client and the real driver."""

import time
from collections.abc import Callable
from math import hypot
from typing import Any

import can
import pytest

from drivers.thorvald import ThorvaldWheels
from drivers.thorvald_protocol import Kind, NmtCommand
from drivers.wire_layout import wire_layout
from fieldnav.messages import Wheel, WheelReport, WheelSetpoint
from fieldnav.simulation.served.served_robot import ServedRobot

LIMIT_S = 20.0
SPEED_MPS, STEERING_RAD = 0.5, 0.1
HEARTBEATS = 0x700

DRIVING = WheelSetpoint(SPEED_MPS, STEERING_RAD)

Client = Callable[[tuple[str, int]], can.BusABC]
Heard = Callable[[can.BusABC, int], can.Message]
Eventually = Callable[[Callable[[], object]], None]


class Host:
    """The driver on the wall clock, as an application runs it."""

    def __init__(self, robot: ServedRobot, bus: can.BusABC) -> None:
        self._wheels = ThorvaldWheels(robot.robot, bus)
        self._started_s = time.monotonic()
        self._wheels.start(0.0)

    def tick(self, setpoint: WheelSetpoint) -> WheelReport:
        """Command all wheels; what they report, once the modules are up."""
        now_s = time.monotonic() - self._started_s
        report = self._wheels.poll(now_s)
        self._wheels.command(now_s, dict.fromkeys(Wheel, setpoint))
        return report if self._wheels.ready else WheelReport()


def at_speed(report: WheelReport) -> bool:
    wheels = report.modules.values()
    return len(wheels) == len(Wheel) and all(
        wheel.speed_mps == pytest.approx(SPEED_MPS, abs=0.02)
        and wheel.steering_rad == pytest.approx(STEERING_RAD, abs=0.01)
        for wheel in wheels
    )


def standing(report: WheelReport) -> bool:
    wheels = report.modules.values()
    return len(wheels) == len(Wheel) and all(wheel.speed_mps == 0 for wheel in wheels)


def test_modules_are_started_driven_and_heard_through_the_real_driver(
    served: ServedRobot, client: Client, eventually: Eventually
) -> None:
    before = served.world.now.pose
    host = Host(served, client(served.hub.address))

    eventually(lambda: at_speed(host.tick(DRIVING)))
    eventually(lambda: standing(host.tick(WheelSetpoint(0.0, STEERING_RAD))))

    after = served.world.now.pose
    assert hypot(after.x_m - before.x_m, after.y_m - before.y_m) > 0.05
    assert served.account().distance_m > 0.05


def test_frames_of_bare_bytes_drive_a_module(served: ServedRobot, client: Client, heard: Heard) -> None:
    bus, layout = client(served.hub.address), wire_layout()
    bus.send(layout.frame(0.0, 0, Kind.NMT, {"Command": NmtCommand.START, "Node": 0}))
    while heard(bus, HEARTBEATS + 1).data != b"\x05":
        pass
    until_s, sequence, rpm = time.monotonic() + LIMIT_S, 0, 0.0

    while rpm < 100 and time.monotonic() < until_s:
        sequence += 1
        bus.send(layout.frame(0.0, 1, Kind.DRIVE, {"Sequence": sequence, "DriveSpeed": 100}))
        bus.send(layout.frame(0.0, 1, Kind.STEER, {"MaximumSteeringSpeed": 0, "SteeringAngle": 50}))
        telegram = layout.read(heard(bus, 0x181))
        assert telegram is not None
        rpm = telegram.values["DriveMotorSpeed"]

    assert rpm >= 100


def test_the_modules_talk_to_all_clients(served: ServedRobot, client: Client, heard: Heard) -> None:
    clients = [client(served.hub.address) for _ in range(3)]

    nodes = [{heard(bus, HEARTBEATS + node).arbitration_id for node in range(1, 5)} for bus in clients]

    assert nodes == [{0x701, 0x702, 0x703, 0x704}] * 3


def test_a_host_that_is_gone_lets_the_wheels_stop(
    served: ServedRobot, client: Client, eventually: Eventually
) -> None:
    bus = client(served.hub.address)
    host = Host(served, bus)
    eventually(lambda: at_speed(host.tick(DRIVING)))

    bus.shutdown()

    eventually(lambda: served.world.now.twist.vx_mps == 0)


def test_a_world_that_is_late_catches_up_with_the_clock(
    served: ServedRobot, clock: Any, client: Client, heard: Heard, eventually: Eventually
) -> None:
    bus = client(served.hub.address)
    heard(bus, HEARTBEATS + 1)
    began_s, world_s = time.monotonic(), served.world.now.stamp_s

    clock.ahead_s = 30.0
    eventually(lambda: served.world.now.stamp_s >= world_s + 30.0)

    passed_s = 30.0 + time.monotonic() - began_s
    assert served.world.now.stamp_s - world_s <= passed_s + 0.1, "and goes no further than the clock"
    assert heard(bus, HEARTBEATS + 1)
