"""A broken bus, a stranger on it, and a full disk do what they are to do and nothing else."""

import errno
from collections.abc import Iterator
from io import BytesIO

import can
import pytest
from can.interfaces.virtual import VirtualBus

from drivers.can_log import open_virtual_pair
from drivers.thorvald_protocol import Kind, NodeState
from drivers.wire_layout import wire_layout
from fieldnav.simulation.injection_bus import FaultyBus
from fieldnav.simulation.injection_disk import FullDisk
from fieldnav.simulation.injection_intruder import Intruder


def heartbeat(node: int) -> can.Message:
    return wire_layout().frame(0.0, node, Kind.HEARTBEAT, {"State": NodeState.OPERATIONAL})


def drive(node: int, speed: int) -> can.Message:
    return wire_layout().frame(0.0, node, Kind.DRIVE, {"Sequence": 1, "DriveSpeed": speed})


@pytest.fixture
def wire() -> Iterator[tuple[FaultyBus, can.BusABC]]:
    host, far = open_virtual_pair()
    yield FaultyBus(host), far
    host.shutdown()
    far.shutdown()


def test_a_bus_that_is_off_takes_nothing_and_gives_nothing(wire: tuple[FaultyBus, can.BusABC]) -> None:
    bus, far = wire
    bus.send(drive(1, 50))
    bus.off = True
    far.send(heartbeat(1))
    with pytest.raises(can.CanOperationError):
        bus.send(drive(1, 80))
    assert bus.recv(timeout=0) is None
    assert (bus.told, bus.commands) == ({1: 50}, 1), "what did not go out was told to nobody"


def test_one_modules_telegrams_are_garbled_and_no_others(wire: tuple[FaultyBus, can.BusABC]) -> None:
    bus, far = wire
    bus.garbled_node = 3
    received = []
    for node in (1, 3) * 30:
        far.send(heartbeat(node))
        received.append(bus.recv(timeout=0))
    kept = [frame for frame in received if frame and bytes(frame.data) == bytes(heartbeat(1).data)]
    assert len(received) == 60
    assert {frame.arbitration_id for frame in kept} == {heartbeat(1).arbitration_id}
    assert len(kept) == 30
    assert len({len(frame.data) for frame in received if frame and frame not in kept}) > 3


def test_an_intruder_floods_disturbs_and_commands_only_when_told() -> None:
    host, far = open_virtual_pair()
    assert isinstance(host, VirtualBus)
    intruder = Intruder(VirtualBus(host.channel_id, preserve_timestamps=True))
    heard = []

    def step(now_s: float) -> list[can.Message]:
        intruder.step(now_s)
        heard.clear()
        while (frame := host.recv(timeout=0)) is not None:
            heard.append(frame)
        return list(heard)

    assert step(0.02) == []
    intruder.flood, intruder.errors = 7, 2
    said = step(0.04)
    assert [frame.is_error_frame for frame in said] == [False] * 7 + [True] * 2
    assert all(wire_layout().heard(frame) is None for frame in said)
    intruder.flood = intruder.errors = 0
    intruder.nodes, intruder.commands_until_s = (1, 2), 0.07
    told = [wire_layout().read(frame) for frame in step(0.06)]
    assert [(each.node, each.kind, each.values["DriveSpeed"]) for each in told if each] == [
        (1, Kind.DRIVE, 0),
        (2, Kind.DRIVE, 0),
    ]
    assert step(0.08) == []
    for bus in (host, far, intruder._bus):
        bus.shutdown()


def test_a_full_disk_refuses_until_there_is_room() -> None:
    room, file = [False], BytesIO()
    disk = FullDisk(file, lambda: room[0])
    with pytest.raises(OSError, match="No space left") as caught:
        disk.write(b"x")
    assert caught.value.errno == errno.ENOSPC
    room[0] = True
    assert disk.write(b"xy") == 2
    assert disk.tell() == 2
