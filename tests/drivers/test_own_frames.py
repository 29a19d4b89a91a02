"""What the host sent itself is nobody else's, where the adapter gives it back; what others sent always is."""

from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path

import can
import pytest
from can.interfaces.virtual import VirtualBus

from drivers.can_log import LoggedBus
from drivers.own_frames import REMEMBERED
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.preflight.hearing import Ear, Hearing
from fieldnav.settings.robot import Robot

numbers = count(1)


class SameComputer(VirtualBus):
    """As SocketCAN marks what another program of the same computer has sent: not received."""

    def recv(self, timeout: float | None = None) -> can.Message | None:
        frame = super().recv(timeout)
        if frame is not None:
            frame.is_rx = False
        return frame


Pair = tuple[can.BusABC, can.BusABC]


@pytest.fixture(params=["echoing", "same computer", "both"])
def pair(request: pytest.FixtureRequest) -> Iterator[Pair]:
    """The host's end of a bus, and the far one."""
    made = SameComputer if request.param != "echoing" else VirtualBus
    echoes, channel = request.param != "same computer", f"own-{next(numbers)}"
    host = made(channel, receive_own_messages=echoes, preserve_timestamps=True)
    far = VirtualBus(channel, preserve_timestamps=True)
    yield host, far
    host.shutdown()
    far.shutdown()


def driven(
    robot: Robot, pair: Pair, seconds: float, then: Callable[[float], None] = lambda now_s: None
) -> ThorvaldWheels:
    """A driver that drives the far end's modules for a while."""
    wheels, modules = ThorvaldWheels(robot, pair[0]), SimulatedModules(robot, pair[1])
    wheels.start(0.0)
    for tick in range(1, round(seconds / 0.02)):
        now_s = tick * 0.02
        modules.step(now_s)
        then(now_s)
        wheels.poll(now_s)
        wheels.command(now_s, dict.fromkeys(Wheel, WheelSetpoint(0.3, 0.1)))
    return wheels


def test_the_hosts_own_commands_are_no_take_over(robot: Robot, pair: Pair) -> None:
    wheels = driven(robot, pair, 3.0)

    assert wheels.ready
    assert not wheels.taken_over


def test_anothers_commands_are_one_whatever_the_adapter_marks(robot: Robot, pair: Pair) -> None:
    values = {"Sequence": 5_000_000, "DriveSpeed": 0}
    frame = wire_layout().frame(0.0, 1, Kind.DRIVE, values)

    with pytest.raises(DriverError) as caught:
        driven(robot, pair, 3.0, lambda now_s: pair[1].send(frame) if now_s > 2 else None)

    assert caught.value.fault is FaultKind.FOREIGN_COMMAND


def test_each_frame_is_once_in_the_log(robot: Robot, pair: Pair, tmp_path: Path) -> None:
    host, far = pair
    logged = LoggedBus(host, tmp_path / "can.log", "can0")
    frame = wire_layout().frame(1.0, 0, Kind.HOST_HEARTBEAT, {"State": 5})

    logged.send(frame)
    far.send(wire_layout().frame(1.1, 1, Kind.HEARTBEAT, {"State": 5}))

    heard = logged.recv(0)
    assert heard is not None
    assert heard.arbitration_id == 0x701
    assert logged.recv(0) is None
    logged.shutdown()
    assert [line.split()[2] for line in (tmp_path / "can.log").read_text().splitlines()] == [
        "77F#05",
        "701#05",
    ]


def test_what_comes_back_is_neither_another_host_nor_load(robot: Robot, pair: Pair) -> None:
    hearing = Hearing(robot)
    ear = Ear(pair[0], hearing, lambda: 0.0)
    ear.send(wire_layout().frame(0.0, 0, Kind.HOST_HEARTBEAT, {"State": 5}))

    assert ear.recv(0) is None
    assert not hearing.foreign
    assert hearing.frames == 0
    ear.shutdown()


def test_a_frame_that_comes_back_twice_is_anothers_the_second_time(robot: Robot, pair: Pair) -> None:
    hearing = Hearing(robot)
    ear = Ear(pair[0], hearing, lambda: 0.0)
    frame = wire_layout().frame(0.0, 0, Kind.HOST_HEARTBEAT, {"State": 5})
    ear.send(frame)
    for _ in range(2):
        pair[1].send(frame)

    assert ear.recv(0) is not None
    assert 0x77F in hearing.foreign
    ear.shutdown()


def test_what_was_sent_long_ago_comes_back_no_more(robot: Robot) -> None:
    host = SameComputer(f"own-{next(numbers)}")
    far = VirtualBus(host.channel_id)
    hearing = Hearing(robot)
    ear = Ear(host, hearing, lambda: 0.0)
    stop = wire_layout().frame(0.0, 0, Kind.NMT, {"Command": 2, "Node": 1})
    ear.send(stop)
    for number in range(REMEMBERED):
        ear.send(wire_layout().frame(0.0, 1, Kind.DRIVE, {"Sequence": number, "DriveSpeed": 0}))

    far.send(stop)

    assert ear.recv(0) is not None
    assert 0 in hearing.foreign
    for bus in (ear, host, far):
        bus.shutdown()


class Padding(VirtualBus):
    """Pads what it is given to eight bytes, in place, as python-can's gs_usb does."""

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        super().send(msg, timeout)
        msg.data.extend(bytes(8 - len(msg.data)))


def test_a_backend_that_pads_what_it_is_given_neither_hides_an_echo_nor_changes_the_log(
    tmp_path: Path,
) -> None:
    host = Padding(f"own-{next(numbers)}", receive_own_messages=True)
    logged = LoggedBus(host, tmp_path / "can.log", "can0")

    logged.send(wire_layout().frame(1.0, 0, Kind.HOST_HEARTBEAT, {"State": 5}))

    assert logged.recv(0) is None
    logged.shutdown()
    assert (tmp_path / "can.log").read_text() == "(1.000000) can0 77F#05 T\n"
