"""A served robot that lives for a test, and python-can's own clients of it."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from threading import Event, Thread

import can
import pytest

from fieldnav.messages import CameraName, Side
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Robot
from fieldnav.simulation.served.can_hub import CanHub
from fieldnav.simulation.served.served_robot import Offer, ServedRobot

LIMIT_S = 20.0
"""Far longer than anything takes, also where another process has the processor."""
POLL_S = 0.005
CHANNEL = "can0"


def with_cameras(robot: Robot, width_px: int, height_px: int) -> Robot:
    changed = {
        name.value: robot.cameras.get(name).model_copy(update={"width_px": width_px, "height_px": height_px})
        for name in CameraName
    }
    return robot.model_copy(update={"cameras": robot.cameras.model_copy(update=changed)})


@pytest.fixture
def eventually() -> Callable[[Callable[[], object]], None]:
    """Waits until a condition holds."""

    def wait(condition: Callable[[], object]) -> None:
        until_s = time.monotonic() + LIMIT_S
        while not condition():
            assert time.monotonic() < until_s, f"not within {LIMIT_S} s"
            time.sleep(POLL_S)

    return wait


@pytest.fixture
def offer() -> Offer:
    field = revised(load_field("demo"), {"lanes": 1, "length_m": 6})
    robot = with_cameras(load_robot("bonnbot"), 320, 180)
    return Offer(field, load_crop(field.crop), robot, Side.RIGHT, sketch=True)


class Clock:
    """The machine's clock, which a test can put forward."""

    def __init__(self) -> None:
        self.ahead_s = 0.0

    def __call__(self) -> float:
        return time.monotonic() + self.ahead_s


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def served(offer: Offer, clock: Clock) -> Iterator[ServedRobot]:
    """In real time, in a thread of its own, as in a process of its own."""
    stopping = Event()
    with ServedRobot(offer, clock) as robot:
        thread = Thread(target=robot.serve, args=(stopping.is_set,))
        thread.start()
        yield robot
        stopping.set()
        thread.join(LIMIT_S)
        assert not thread.is_alive()


@pytest.fixture
def hub() -> Iterator[CanHub]:
    """A bus without modules, which the test attends itself."""
    bus = CanHub(0, CHANNEL, time.monotonic, time.time() - time.monotonic())
    yield bus
    bus.close()


@pytest.fixture
def attended(hub: CanHub) -> Iterator[CanHub]:
    """The same, attended in a thread of its own for the length of the test."""
    stopping = Event()

    def attend() -> None:
        while not stopping.is_set():
            hub.attend(time.monotonic() + POLL_S)

    thread = Thread(target=attend)
    thread.start()
    yield hub
    stopping.set()
    thread.join(LIMIT_S)
    assert not thread.is_alive()


@pytest.fixture
def client() -> Iterator[Callable[[tuple[str, int]], can.BusABC]]:
    """Makes clients of a bus at an address, closed in the end."""
    with ExitStack() as stack:

        def connect(address: tuple[str, int]) -> can.BusABC:
            host, port = address
            bus = can.Bus(interface="socketcand", channel=CHANNEL, host=host, port=port, ignore_config=True)
            stack.callback(bus.shutdown)
            return bus

        yield connect


@pytest.fixture
def heard() -> Callable[[can.BusABC, int], can.Message]:
    """Waits for the next frame of an identifier."""

    def wait(bus: can.BusABC, identifier: int) -> can.Message:
        until_s = time.monotonic() + LIMIT_S
        while time.monotonic() < until_s:
            frame = bus.recv(timeout=0.1)
            if frame is not None and frame.arbitration_id == identifier:
                return frame
        raise AssertionError(f"no frame {identifier:X} within {LIMIT_S} s")

    return wait
