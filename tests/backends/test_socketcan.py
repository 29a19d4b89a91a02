"""The driver, the simulated modules and a mission on a kernel's SocketCAN: see machine.sh."""

import subprocess
from collections.abc import Callable, Iterator
from contextlib import suppress
from itertools import pairwise
from pathlib import Path

import can
import pytest

from drivers.bus_watch import BUS_OFF_BIT, MOST_ERRORS
from drivers.can_log import LoggedBus, open_bus
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Side, Wheel, WheelReport, WheelSetpoint
from fieldnav.mission import simulated
from fieldnav.mission.simulated import Run
from fieldnav.settings.camera import Cameras
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Bus, Robot

from .socketcan import LINES, is_there, open_stepped_pair

TICK_S = 0.02
FORWARD = WheelSetpoint(0.5, 0.0)
GARBLED = can.Message(is_error_frame=True, arbitration_id=0x08, is_extended_id=False, data=bytes(8))
BUS_OFF = can.Message(is_error_frame=True, arbitration_id=BUS_OFF_BIT, is_extended_id=False, data=bytes(8))
"""As a controller's driver reports them: CAN_ERR_PROT and CAN_ERR_BUSOFF of linux/can/error.h."""
FILLING = can.Message(arbitration_id=0x7F0, is_extended_id=False, data=bytes(8))
FLOOD_A_TICK = 150
"""7,500 frames a second, twice what the wire carries; a socket's buffer takes them."""
FOREIGN_DRIVE = can.Message(
    arbitration_id=0x203, is_extended_id=False, data=bytes.fromhex("0700000028000000")
)


SMALL = {"width_px": 320, "height_px": 180}


def ip(*words: str) -> None:
    subprocess.run(["ip", *words], check=True)


def skip_without(line: str) -> None:
    if not is_there(line):
        pytest.skip(f"needs the interfaces {', '.join(LINES[line])}")


def with_small_cameras() -> Robot:
    """An emulated processor draws few pixels a second."""
    robot = load_robot("bonnbot")
    small = {name: robot.cameras.get(name).model_copy(update=SMALL) for name in CameraName}
    return robot.model_copy(
        update={"cameras": Cameras(front=small[CameraName.FRONT], rear=small[CameraName.REAR])}
    )


class Bench:
    """Driver and modules in turns on one bus, on a stepped clock; `intruder` is a third member."""

    def __init__(self, robot: Robot, line: str, log: Path) -> None:
        self.wire, self.far = open_stepped_pair(line)
        self.now_s = 0.0
        self.host = LoggedBus(self.wire, log, LINES[line][0], clock=lambda: self.now_s)
        self.wheels = ThorvaldWheels(robot, self.host)
        self.modules = SimulatedModules(robot, self.far)
        self.intruder = open_bus(Bus(interface="socketcan", channel=LINES[line][1]))
        self.report = WheelReport()

    def tick(self, setpoint: WheelSetpoint | None = None) -> None:
        self.now_s = round(self.now_s + TICK_S, 6)
        self.modules.step(self.now_s)
        self.report = self.wheels.poll(self.now_s)
        if setpoint is not None:
            self.wheels.command(self.now_s, dict.fromkeys(Wheel, setpoint))

    def run(self, seconds: float, setpoint: WheelSetpoint | None = None) -> None:
        for _ in range(round(seconds / TICK_S)):
            self.tick(setpoint)

    def start(self) -> None:
        self.wheels.start(self.now_s)
        self.run(0.2)
        assert self.wheels.ready

    def fault_of(self, seconds: float) -> DriverError:
        with pytest.raises(DriverError) as caught:
            self.run(seconds, FORWARD)
        return caught.value

    def forget_what_was_lost(self) -> None:
        """After the line has been cut: no end awaits anything, and the modules have heard of it."""
        for end in (self.far, self.wire):
            end.coming.clear()
            with suppress(can.CanError):
                end.recv()

    def close(self) -> None:
        for bus in (self.host, self.far, self.intruder):
            bus.shutdown()


@pytest.fixture
def bench_on(tmp_path: Path) -> Iterator[Callable[[str], Bench]]:
    made: list[Bench] = []

    def make(line: str) -> Bench:
        skip_without(line)
        made.append(Bench(load_robot("bonnbot"), line, tmp_path / "can.log"))
        return made[-1]

    yield make
    for bench in made:
        bench.close()


@pytest.mark.parametrize("line", LINES)
def test_the_modules_come_up_and_do_what_they_are_told(bench_on: Callable[[str], Bench], line: str) -> None:
    bench = bench_on(line)
    bench.start()

    bench.run(2.0, FORWARD)

    assert {wheel: report.speed_mps for wheel, report in bench.report.modules.items()} == {
        wheel: pytest.approx(0.5, abs=0.002) for wheel in Wheel
    }
    assert not bench.wheels.taken_over, "the host's own frames are no intruder's"


@pytest.mark.parametrize("line", LINES)
def test_the_log_tells_what_was_sent_from_what_was_received(
    bench_on: Callable[[str], Bench], tmp_path: Path, line: str
) -> None:
    bench = bench_on(line)
    bench.start()
    bench.run(1.5, FORWARD)
    bench.host.shutdown()

    with can.CanutilsLogReader(tmp_path / "can.log") as reader:
        frames = list(reader)
    sent = {frame.arbitration_id for frame in frames if not frame.is_rx}
    received = {frame.arbitration_id for frame in frames if frame.is_rx}
    assert {0x000, 0x201, 0x501, 0x601, 0x77F} <= sent
    assert {0x181, 0x281, 0x381, 0x701} <= received
    assert not sent & received
    assert all(before.timestamp <= after.timestamp for before, after in pairwise(frames))


@pytest.mark.parametrize("line", LINES)
def test_another_sender_on_the_line_is_noticed(bench_on: Callable[[str], Bench], line: str) -> None:
    bench = bench_on(line)
    bench.start()

    bench.intruder.send(FOREIGN_DRIVE)
    error = bench.fault_of(2.0)

    assert error.fault is FaultKind.FOREIGN_COMMAND
    assert "node 3" in str(error)


def test_a_bus_off_and_a_garbled_bus_are_told_apart_by_the_kernels_error_frames(
    bench_on: Callable[[str], Bench],
) -> None:
    bench = bench_on("virtual")
    bench.start()

    for _ in range(3 * MOST_ERRORS):
        bench.intruder.send(GARBLED)
    garbled = bench.fault_of(0.1)
    bench.intruder.send(BUS_OFF)
    off = bench.fault_of(0.1)

    assert (garbled.fault, off.fault) == (FaultKind.BUS_GARBLED, FaultKind.BUS_OFF)


def test_a_flood_on_the_line_is_noticed(bench_on: Callable[[str], Bench]) -> None:
    bench = bench_on("virtual")
    bench.start()

    with pytest.raises(DriverError) as caught:
        for _ in range(round(1.0 / TICK_S)):
            for _ in range(FLOOD_A_TICK):
                bench.intruder.send(FILLING)
            bench.tick(FORWARD)

    assert caught.value.fault is FaultKind.BUS_FLOODED


def test_an_interface_that_is_down_is_said_and_serves_again_when_it_is_up(
    bench_on: Callable[[str], Bench],
) -> None:
    bench = bench_on("virtual")
    bench.start()

    ip("link", "set", "vcan0", "down")
    with pytest.raises(DriverError, match=r"CAN bus cannot be read: .*Network is down"):
        bench.wheels.poll(bench.now_s)
    with pytest.raises(DriverError, match=r"CAN bus cannot be written: .*Network is down"):
        bench.wheels.command(bench.now_s, dict.fromkeys(Wheel, FORWARD))
    ip("link", "set", "vcan0", "up")
    bench.forget_what_was_lost()
    bench.run(2.0, FORWARD)

    assert bench.report.modules[Wheel.FRONT_LEFT].speed_mps == pytest.approx(0.5, abs=0.002)


def test_an_interface_that_is_gone_is_said_at_every_command(bench_on: Callable[[str], Bench]) -> None:
    bench = bench_on("virtual")
    bench.start()

    ip("link", "del", "vcan0")
    try:
        with pytest.raises(DriverError, match=r"CAN bus cannot be read: .*"):
            bench.wheels.poll(bench.now_s)
        for _ in range(2):
            with pytest.raises(DriverError, match=r"CAN bus cannot be written: .*"):
                bench.wheels.command(bench.now_s, dict.fromkeys(Wheel, FORWARD))
    finally:
        ip("link", "add", "vcan0", "type", "vcan")
        ip("link", "set", "vcan0", "up")


def test_a_short_mission_is_driven_over_two_controllers(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    skip_without("controllers")
    monkeypatch.setattr(simulated, "open_virtual_pair", lambda: open_stepped_pair("controllers"))
    field = revised(load_field("demo"), {"lanes": 1, "length_m": 4})
    run = Run(field, load_crop(field.crop), with_small_cameras(), 1, Side.RIGHT, tmp_path, sketch=True)

    summary = simulated.simulate(run).summary

    assert summary.completed
    assert summary.truth is not None and summary.truth.crop_plants_run_over == 0
