import os
import socket
import subprocess
import sys
from importlib.resources import files
from threading import Thread

import can
import pytest

from drivers.can_log import LoggedBus, open_bus, open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from drivers.wire_layout import wire_layout
from fieldnav.errors import DriverError, OutputError
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.settings.robot import Bus


def drive(robot, path, seconds=3.0):
    """A short drive with everything there is on the bus; how many frames both ends sent."""
    host, far = open_virtual_pair()
    tap = can.interfaces.virtual.VirtualBus(host.channel_id, preserve_timestamps=True)
    wheels = ThorvaldWheels(robot, LoggedBus(host, path, "can0"))
    modules = SimulatedModules(robot, far, can_delay_s=0.005)
    wheels.start(0.0)
    for tick in range(round(seconds * 50)):
        now_s = tick * 0.02
        modules.step(now_s)
        wheels.poll(now_s)
        wheels.command(now_s, dict.fromkeys(Wheel, WheelSetpoint(0.5, 0.1)))
    modules.step(seconds)
    wheels.poll(seconds)
    wheels.emergency_stop(seconds)
    modules.step(seconds + 0.1)
    wheels.poll(seconds + 0.1)
    count = 0
    while tap.recv(timeout=0) is not None:
        count += 1
    wheels.close()
    for bus in (far, tap):
        bus.shutdown()
    return count


def test_every_frame_is_in_the_log_once_and_in_order(robot, tmp_path):
    sent = drive(robot, tmp_path / "can.log")

    with can.CanutilsLogReader(tmp_path / "can.log") as reader:
        frames = list(reader)
    assert len(frames) == sent
    stamps = [frame.timestamp for frame in frames]
    assert stamps == sorted(stamps)
    assert {frame.channel for frame in frames} == {"can0"}
    assert {frame.arbitration_id for frame in frames if not frame.is_rx} >= {
        0x000,
        0x201,
        0x501,
        0x601,
        0x77F,
    }
    assert {frame.arbitration_id for frame in frames if frame.is_rx} >= {
        0x81,
        0x181,
        0x281,
        0x381,
        0x481,
        0x3C1,
    }
    assert all(wire_layout().read(frame) is not None for frame in frames)


class SharedBus(can.BusABC):
    """A bus that marks what another program of the same computer has sent, as SocketCAN does."""

    def __init__(self):
        super().__init__(channel="shared")

    def recv(self, timeout=None):
        return can.Message(arbitration_id=0x181, data=bytes(8), is_extended_id=False, is_rx=False)

    def send(self, msg, timeout=None):
        pass


def test_what_another_program_of_this_computer_sent_was_received(tmp_path):
    bus = LoggedBus(SharedBus(), tmp_path / "can.log", "vcan0")

    bus.recv()
    bus.send(can.Message(arbitration_id=0x201, data=bytes(8), is_extended_id=False))
    bus.shutdown()

    lines = (tmp_path / "can.log").read_text().splitlines()
    assert [line.split()[-1] for line in lines] == ["R", "T"]


def test_cantools_decodes_every_line_of_the_log(robot, tmp_path):
    drive(robot, tmp_path / "can.log", seconds=1.2)
    lines = (tmp_path / "can.log").read_text()

    done = subprocess.run(
        [sys.executable, "-m", "cantools", "decode", "-s", str(files("config").joinpath("thorvald.dbc"))],
        input=lines,
        capture_output=True,
        text=True,
        check=True,
    )

    decoded = done.stdout.splitlines()
    assert len(decoded) == len(lines.splitlines())
    assert all(" :: " in line and line.endswith(")") and "Unknown" not in line for line in decoded)


def test_the_same_drive_gives_the_same_log_byte_for_byte(robot, tmp_path):
    drive(robot, tmp_path / "one.log")
    drive(robot, tmp_path / "two.log")

    assert (tmp_path / "one.log").read_bytes() == (tmp_path / "two.log").read_bytes()


def test_the_log_is_on_the_disk_up_to_the_last_second_before_it_is_closed(tmp_path):
    host, far = open_virtual_pair()
    bus = LoggedBus(host, tmp_path / "can.log", "can0")
    for tenth in range(31):
        bus.send(can.Message(timestamp=tenth / 10, arbitration_id=0x77F, is_extended_id=False, data=[5]))

    assert "(3.000000) can0 77F#05 T\n" in (tmp_path / "can.log").read_text()
    bus.shutdown()
    bus.shutdown()
    far.shutdown()


def beat(stamp_s):
    return can.Message(timestamp=stamp_s, arbitration_id=0x77F, is_extended_id=False, data=[5])


def fill(bus, full_disk):
    """From now on the disk below the log of this bus is full."""
    with full_disk.open("w") as full:
        os.dup2(full.fileno(), bus._log.file.fileno())


@pytest.mark.parametrize("stamps_s", [[1.1], [0.1] * 2000], ids=["at a flush", "as its buffer runs over"])
def test_a_log_that_finds_no_room_lets_every_frame_pass_and_says_why(full_disk, tmp_path, stamps_s):
    host, far = open_virtual_pair()
    bus = LoggedBus(host, tmp_path / "can.log", "can0")
    bus.send(beat(0.0))
    assert bus.failure is None
    fill(bus, full_disk)

    for stamp_s in stamps_s:
        bus.send(beat(stamp_s))
    far.send(beat(2.0))

    assert bus.recv(timeout=0) is not None
    assert bus.failure == "can.log cannot be written: No space left on device"
    assert sum(1 for _ in iter(lambda: far.recv(timeout=0), None)) == 1 + len(stamps_s)
    assert (tmp_path / "can.log").read_text() == "(0.000000) can0 77F#05 T\n"
    bus.shutdown()
    far.shutdown()


def test_a_log_whose_last_lines_find_no_room_closes_the_bus_and_says_why(full_disk, tmp_path):
    host, far = open_virtual_pair()
    bus = LoggedBus(host, tmp_path / "can.log", "can0")
    bus.send(beat(0.0))
    fill(bus, full_disk)
    bus.send(beat(0.1))
    assert bus.failure is None

    bus.shutdown()
    bus.shutdown()

    assert bus.failure == "can.log cannot be written: No space left on device"
    with pytest.raises(can.CanError):
        host.send(beat(0.2))
    far.shutdown()


def test_a_log_that_cannot_be_begun_is_an_output_error_and_closes_the_bus(tmp_path):
    host, far = open_virtual_pair()

    with pytest.raises(OutputError, match=r"nowhere/can\.log: cannot be written: No such file"):
        LoggedBus(host, tmp_path / "nowhere" / "can.log", "can0")

    with pytest.raises(can.CanError):
        host.send(can.Message(arbitration_id=1, is_extended_id=False))
    far.shutdown()


def test_two_virtual_pairs_do_not_hear_each_other():
    one, two = open_virtual_pair(), open_virtual_pair()
    one[0].send(can.Message(arbitration_id=1, is_extended_id=False))

    assert one[1].recv(timeout=0) is not None
    assert two[1].recv(timeout=0) is None
    for bus in (*one, *two):
        bus.shutdown()


def test_a_bus_that_is_not_there_is_named():
    with pytest.raises(DriverError, match="interface socketcan, channel nowhere0"):
        open_bus(Bus(interface="socketcan", channel="nowhere0"))
    with pytest.raises(DriverError, match="interface pigeon"):
        open_bus(Bus(interface="pigeon", channel="can0"))


def close_the_first(server):
    server.accept()[0].close()


@pytest.mark.parametrize(("closes", "said"), [(False, "timed out"), (True, "closed the connection")])
def test_a_server_that_does_not_greet_is_not_waited_for(closes, said, monkeypatch):
    monkeypatch.setattr("drivers.can_log.SERVER_S", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as server:
        there = {"host": "127.0.0.1", "port": server.getsockname()[1]}
        if closes:
            Thread(target=close_the_first, args=(server,), daemon=True).start()
        with pytest.raises(DriverError, match=f"interface socketcand, channel can0: .*{said}"):
            open_bus(Bus(interface="socketcand", channel="can0", options=there))
