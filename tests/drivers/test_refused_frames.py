"""A bus that refuses single frames, as one does whose queue is full: who still hears the host."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import can
import pytest

from drivers.can_log import LoggedBus, open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import DriverError
from fieldnav.messages import Wheel, WheelSetpoint

TICK_S = 0.02
FULL = can.CanOperationError("no buffer space available")
DRIVES = (0x201, 0x202, 0x203, 0x204)
STEERS = (0x501, 0x502, 0x503, 0x504)
REQUESTS = (0x601, 0x602, 0x603, 0x604)
FORWARD = WheelSetpoint(0.5, 0.0)


class NarrowBus(can.BusABC):
    """A working bus that refuses the frames of some ids and lists those that it passed on."""

    def __init__(self, bus: can.BusABC) -> None:
        super().__init__(channel="narrow")
        self.bus = bus
        self.refused: dict[int, Exception] = {}
        self.passed: list[int] = []

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        if msg.arbitration_id in self.refused:
            raise self.refused[msg.arbitration_id]
        self.bus.send(msg, timeout)
        self.passed.append(msg.arbitration_id)

    def recv(self, timeout: float | None = None) -> can.Message | None:
        return self.bus.recv(timeout)

    def shutdown(self) -> None:
        super().shutdown()
        self.bus.shutdown()


class PulledOutBus(NarrowBus):
    """A bus whose adapter is gone; some backends let the system's own error through."""

    def recv(self, timeout: float | None = None) -> can.Message | None:
        raise OSError(19, "No such device")


@dataclass
class Line:
    bus: NarrowBus
    wheels: ThorvaldWheels
    modules: SimulatedModules
    now_s: float = field(default=0.0)

    def run(self, seconds: float, setpoint: WheelSetpoint | None = None) -> None:
        for _ in range(round(seconds / TICK_S)):
            self.now_s = round(self.now_s + TICK_S, 6)
            self.modules.step(self.now_s)
            self.wheels.poll(self.now_s)
            if setpoint:
                self.wheels.command(self.now_s, dict.fromkeys(Wheel, setpoint))


@pytest.fixture
def line(robot) -> Iterator[Line]:
    host, far = open_virtual_pair()
    bus = NarrowBus(host)
    line = Line(bus, ThorvaldWheels(robot, bus), SimulatedModules(robot, far))
    line.wheels.start(0.0)
    line.run(0.1)
    assert line.wheels.ready
    line.run(1.0, FORWARD)
    bus.passed.clear()
    yield line
    bus.shutdown()
    far.shutdown()


@pytest.mark.parametrize("refused", DRIVES + STEERS)
@pytest.mark.parametrize("error", [FULL, OSError(105, "No buffer space available")], ids=["can", "os"])
def test_stop_reaches_every_module_but_the_one_whose_frame_is_refused_and_never_raises(line, refused, error):
    line.bus.refused = {refused: error}

    line.wheels.stop(line.now_s)

    assert sorted(line.bus.passed) == sorted({*DRIVES, *STEERS} - {refused})


@pytest.mark.parametrize("refused", DRIVES)
def test_the_wheels_that_are_reached_stand_and_the_other_stops_by_its_watchdog(line, refused):
    line.bus.refused = {refused: FULL}
    line.wheels.stop(line.now_s)

    # Short of the watchdog's 0.2 s the module without a zero still drives; the others are on their ramp.
    line.modules.step(line.now_s + 0.1)

    speeds = [state.speed_mps for state in line.modules.wheel_states().values()]
    assert sum(speed > 0.45 for speed in speeds) == 1
    line.modules.step(line.now_s + 1.0)
    assert [state.speed_mps for state in line.modules.wheel_states().values()] == [0, 0, 0, 0]


def test_a_refused_command_names_the_first_module_after_all_others_have_theirs(line):
    line.bus.refused = {0x202: FULL, 0x203: FULL}

    with pytest.raises(DriverError, match=r"front_right \(node 2\): CAN bus cannot be written: no buffer"):
        line.wheels.command(line.now_s, dict.fromkeys(Wheel, FORWARD))

    assert sorted(line.bus.passed) == sorted([0x201, 0x204, *STEERS])


def test_the_emergency_stop_goes_out_also_where_zero_could_not(line):
    line.bus.refused = dict.fromkeys((*DRIVES, 0x602), FULL)

    with pytest.raises(DriverError):
        line.wheels.emergency_stop(line.now_s)

    assert set(REQUESTS) & set(line.bus.passed) == {0x601, 0x603, 0x604}


def test_no_module_is_released_from_the_emergency_stop_while_one_has_not_got_its_zero(line):
    line.bus.refused = {0x203: FULL}

    with pytest.raises(DriverError, match="front_left"):
        line.wheels.release_emergency_stop(line.now_s)

    assert not set(REQUESTS) & set(line.bus.passed)


def test_bringing_up_asks_the_other_modules_when_one_cannot_be_asked(line):
    line.bus.refused = {0x601: FULL}

    with pytest.raises(DriverError, match=r"rear_right \(node 1\)"):
        line.wheels.start(line.now_s)

    assert {0x602, 0x603, 0x604} <= set(line.bus.passed)


def test_a_bus_that_fails_while_it_is_read_is_a_driver_error(robot):
    host, far = open_virtual_pair()
    bus = PulledOutBus(host)
    wheels = ThorvaldWheels(robot, bus)

    with pytest.raises(DriverError, match=r"cannot be read: .*No such device"):
        wheels.poll(0.0)
    bus.shutdown()
    far.shutdown()


def test_a_full_disk_keeps_no_zero_from_the_wheels(robot, full_disk):
    host, far = open_virtual_pair()
    logged = LoggedBus(host, full_disk, "can0")
    wheels, modules = ThorvaldWheels(robot, logged), SimulatedModules(robot, far)
    line = Line(NarrowBus(host), wheels, modules)
    wheels.start(0.0)
    line.run(1.2, FORWARD)
    assert min(state.speed_mps for state in modules.wheel_states().values()) > 0.45

    wheels.stop(line.now_s)
    modules.step(line.now_s + 0.1)

    assert max(state.speed_mps for state in modules.wheel_states().values()) < 0.4
    assert logged.failure == "full cannot be written: No space left on device"
    wheels.close()
    far.shutdown()
