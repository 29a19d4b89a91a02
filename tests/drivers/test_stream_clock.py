"""A frame that the network held up is told by its own stamp; a stream without stamps is taken as it comes."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.stream_clock import MAX_DRIFT, StreamClock

FRAME_S = 1 / 15
OWN_ZERO_S = 4000.0
"""Where the stream's own count stands when it is opened."""


def lateness_s(delays_s: list[float], own_rate: float = 1.0) -> list[float]:
    """How late each frame of a stream is told to be that took so long from its stamp to its arrival."""
    clock, told = StreamClock(), []
    for number, delay_s in enumerate(delays_s):
        made_s = number * FRAME_S
        arrived_s = made_s + delay_s
        told.append(arrived_s - clock.punctual_s(OWN_ZERO_S + own_rate * made_s, arrived_s))
    return told


def test_frames_that_were_held_up_are_late_by_as_much() -> None:
    backlog_s = [1.4 - number * FRAME_S for number in range(20)]

    told = lateness_s([0.1] * 30 + [0.1 + late_s for late_s in backlog_s] + [0.1] * 5)

    assert told[30:50] == pytest.approx(backlog_s, abs=0.01)
    assert told[:30] + told[50:] == pytest.approx([0.0] * 35, abs=0.01)


def test_a_delay_that_grows_by_50_ms_a_second_is_told() -> None:
    told = lateness_s([0.1 + 0.05 * number * FRAME_S for number in range(300)])

    assert told[-1] == pytest.approx(0.05 * 299 * FRAME_S, rel=0.05)


@pytest.mark.parametrize("own_rate", [1 - 1e-4, 1 + 1e-4])
def test_clocks_that_drift_apart_for_an_hour_make_no_frame_late(own_rate: float) -> None:
    assert max(lateness_s([0.1] * 3600 * 15, own_rate)) < 0.001


@pytest.mark.parametrize("own_s", [[0.0] * 9, [5.0, 6.0, 7.0, 1.0, 2.0, 3.0]])
def test_stamps_that_do_not_go_on_begin_anew(own_s: list[float]) -> None:
    clock = StreamClock()

    punctual_s = [clock.punctual_s(stamp_s, float(number)) for number, stamp_s in enumerate(own_s)]

    assert punctual_s == pytest.approx(range(len(own_s)))


@given(st.lists(st.floats(0.0, 3.0), min_size=2, max_size=40))
def test_no_frame_is_punctual_before_another_that_came_first_or_after_it_came(waits_s: list[float]) -> None:
    clock, arrived_s, before_s = StreamClock(), 0.0, float("-inf")

    for number, wait_s in enumerate(waits_s):
        arrived_s += wait_s
        punctual_s = clock.punctual_s(number * FRAME_S, arrived_s)
        assert before_s <= punctual_s + 1e-9 and punctual_s <= arrived_s + 1e-9
        before_s = punctual_s


def test_a_lasting_delay_is_forgotten_no_faster_than_clocks_drift() -> None:
    told = lateness_s([0.1] * 15 + [0.6] * 150)

    assert told[-1] >= 0.5 - MAX_DRIFT * 150 * FRAME_S - 0.001
