"""A process that was suspended in the middle of a round, or of its commands, moves nothing afterwards."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf, nan

import can
import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.settings.robot import Robot

TICK_S = 0.02
FORWARD, STANDING = (
    dict.fromkeys(Wheel, WheelSetpoint(0.5, 0.0)),
    dict.fromkeys(Wheel, WheelSetpoint(0.0, 0.0)),
)
FRAMES = 2 * len(Wheel)


@dataclass
class Clock:
    """A clock that jumps after it was looked at so many times more."""

    now_s: float = 0.0
    looks: float = inf
    jump_s: float = 0.0

    def __call__(self) -> float:
        self.looks -= 1
        return self.now_s + (self.jump_s if self.looks < 0 else 0.0)


@dataclass
class Suspended:
    """A driver whose process is suspended, and simulated modules at the far end of its bus."""

    wheels: ThorvaldWheels
    modules: SimulatedModules
    far: can.BusABC
    clock: Clock

    def round(self) -> None:
        self.clock.now_s = round(self.clock.now_s + TICK_S, 6)
        self.modules.step(self.clock.now_s)
        self.wheels.poll(self.clock.now_s)

    def command(self, setpoints: dict[Wheel, WheelSetpoint], after_looks: int, for_s: float) -> None:
        """Command the wheels; the process is suspended when the clock was looked at so many times."""
        self.clock.looks, self.clock.jump_s = after_looks, for_s
        self.wheels.command(self.clock.now_s, setpoints)

    def moving_frames(self) -> int:
        """Drive set-points other than zero that the modules have not yet taken in."""
        told = 0
        while (frame := self.far.recv(timeout=0)) is not None:
            telegram = wire_layout().read(frame)
            told += (
                telegram is not None and telegram.kind is Kind.DRIVE and telegram.values["DriveSpeed"] != 0
            )
        return told


@pytest.fixture
def suspended(robot: Robot) -> Iterator[Suspended]:
    host, far = open_virtual_pair()
    clock = Clock()
    wheels = ThorvaldWheels(robot, host, clock=clock)
    rig = Suspended(wheels, SimulatedModules(robot, far), far, clock)
    wheels.start(0.0)
    for _ in range(5):
        rig.round()
    assert wheels.ready
    rig.round()
    yield rig
    for bus in (host, far):
        bus.shutdown()


@pytest.mark.parametrize("looks", range(FRAMES))
def test_after_a_suspension_between_two_frames_no_more_set_points_go_out(
    suspended: Suspended, looks: int
) -> None:
    with pytest.raises(DriverError, match=r"its set-point was decided 5.00 s ago, limit 0.10 s") as caught:
        suspended.command(FORWARD, looks, 5.0)

    assert caught.value.fault is FaultKind.LOOP_LATE
    assert suspended.moving_frames() == (looks + 1) // 2


@pytest.mark.parametrize("late_s", [0.101, -0.001, nan, inf])
def test_a_time_that_cannot_be_gone_by_moves_nothing(suspended: Suspended, late_s: float) -> None:
    with pytest.raises(DriverError):
        suspended.command(FORWARD, 0, late_s)

    assert suspended.moving_frames() == 0


def test_a_round_that_is_not_too_long_moves_all_four(suspended: Suspended) -> None:
    suspended.command(FORWARD, 0, 0.099)

    assert suspended.moving_frames() == len(Wheel)


def test_zero_is_sent_however_late_it_is(suspended: Suspended) -> None:
    suspended.command(STANDING, 0, 5.0)
    suspended.wheels.stop(suspended.clock.now_s)

    assert suspended.moving_frames() == 0
