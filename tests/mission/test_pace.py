"""The beat of the loop, on a clock of the test's own."""

import time

import pytest

from fieldnav.mission.loop import TICK_S
from fieldnav.mission.pace import Pace, RunClock


class Clock:
    """Goes on when it is waited for, and by what the test says a round takes."""

    def __init__(self) -> None:
        self.now_s = 0.0

    def __call__(self) -> float:
        return self.now_s

    def wait(self, seconds: float) -> None:
        assert seconds > 0
        self.now_s += seconds


def test_rounds_begin_at_the_rate_of_the_wheel_commands() -> None:
    clock = Clock()
    pace = Pace(clock, clock.wait)

    begun = []
    for _ in range(5):
        begun.append(pace.next())
        clock.now_s += 0.005  # what a round takes

    assert begun == pytest.approx([TICK_S * number for number in range(1, 6)])
    assert pace.health().late_max_ms == 0


def test_a_short_delay_is_made_up_for_and_a_long_one_is_not() -> None:
    clock = Clock()
    pace = Pace(clock, clock.wait)
    pace.next()

    clock.now_s += 0.03
    assert pace.next() == pytest.approx(0.05)
    assert pace.next() == pytest.approx(0.06)
    clock.now_s += 0.5
    late_s = pace.next()
    assert late_s == pytest.approx(0.56)
    assert pace.next() == pytest.approx(late_s + TICK_S)


def test_lateness_is_told_with_its_worst_and_its_usual_worst() -> None:
    clock = Clock()
    pace = Pace(clock, clock.wait)
    for number in range(200):
        pace.next()
        clock.now_s += 0.025 if number == 100 else 0.005

    health = pace.health()

    assert health.rounds == 200
    assert health.late_max_ms == pytest.approx(5.0, abs=0.1)
    assert health.late_p99_ms <= 1.0


def test_a_run_that_is_taken_up_goes_on_from_its_last_stamp() -> None:
    clock = RunClock(begin_s=120.0)

    assert 120.0 <= clock() < 121.0


def test_a_jump_of_the_wall_clock_is_told_once_and_moves_no_stamp(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = RunClock()
    before_s = clock()
    true_time = time.time
    monkeypatch.setattr(time, "time", lambda: true_time() + 3600)

    assert clock.jumped_s() == pytest.approx(3600, abs=0.5)
    assert clock.jumped_s() == pytest.approx(0, abs=0.5)
    assert clock() - before_s < 60
