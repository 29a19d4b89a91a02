"""A process that was suspended in the middle of a round, or of its commands, moves nothing afterwards."""

from dataclasses import dataclass
from math import inf, nan
from typing import Any

import pytest

from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Wheel, WheelSetpoint

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
    """A bench whose process is suspended while it commands the wheels."""

    bench: Any
    clock: Clock

    def command(self, setpoints: dict[Wheel, WheelSetpoint], after_looks: int, for_s: float) -> None:
        """Command the wheels; the process is suspended when the clock was looked at so many times."""
        self.clock.now_s, self.clock.looks, self.clock.jump_s = self.bench.now_s, after_looks, for_s
        self.bench.wheels.command(self.bench.now_s, setpoints)

    def moving_frames(self) -> int:
        """Drive set-points other than zero on the bus so far."""
        telegrams = map(wire_layout().read, self.bench.frames())
        drives = [each for each in telegrams if each is not None and each.kind is Kind.DRIVE]
        return sum(each.values["DriveSpeed"] != 0 for each in drives)


@pytest.fixture
def suspended(bench_by: Any) -> Suspended:
    clock = Clock()
    bench = bench_by(clock)
    bench.start()
    return Suspended(bench, clock)


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
    suspended.bench.wheels.stop(suspended.bench.now_s)

    assert suspended.moving_frames() == 0
