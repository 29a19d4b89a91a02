"""A bus that is ill is told from one that is busy, and from one that was not listened to for a while."""

import can
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.bus_watch import BURST_S, BUS_OFF_BIT, FRAME_BITS, FULLEST, MOST_ERRORS, BusWatch
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.settings.robot import Bus

BUS = Bus(interface="virtual", channel="test", bitrate=500_000)
TICK_S = 0.02
WIRE_PER_S = BUS.bitrate / FRAME_BITS
"""Frames that the wire can carry at all."""
OWN_PER_S = 740
"""Frames of four modules, the battery and the host: a fifth of that."""
FRAME = can.Message(arbitration_id=0x181, is_extended_id=False, data=bytes(8))
ERROR = can.Message(is_error_frame=True, arbitration_id=0x04)
OFF = can.Message(is_error_frame=True, arbitration_id=BUS_OFF_BIT)


def listen(
    watch: BusWatch, seconds: float, per_s: float, frame: can.Message = FRAME, from_s: float = 0.0
) -> None:
    """Rounds of the loop with so many frames a second."""
    due = 0.0
    for tick in range(1, round(seconds / TICK_S) + 1):
        due += per_s * TICK_S
        while due >= 1:
            watch.take(frame)
            due -= 1
        watch.judge(from_s + tick * TICK_S)


def catch_up(watch: BusWatch, waiting: int, from_s: float) -> float:
    """Rounds of the loop in which frames are read that have waited; the time of the last."""
    now_s = from_s - TICK_S
    while waiting > 0:
        now_s += TICK_S
        for _ in range(min(waiting, watch.most_at_once)):
            watch.take(FRAME)
        waiting -= watch.most_at_once
        watch.judge(now_s)
    return now_s


def stamped(stamp_s: float) -> can.Message:
    return can.Message(timestamp=stamp_s, arbitration_id=0x181, is_extended_id=False, data=bytes(8))


def test_the_robots_own_traffic_is_no_flood() -> None:
    listen(BusWatch(BUS), 60.0, OWN_PER_S)


def test_a_flood_is_noticed_within_a_second() -> None:
    with pytest.raises(DriverError, match=r"beyond 2400 a second, limit 600") as caught:
        listen(BusWatch(BUS), 1.0, 0.9 * WIRE_PER_S)
    assert caught.value.fault is FaultKind.BUS_FLOODED


@settings(max_examples=30, deadline=None)
@given(st.floats(0.0, FULLEST * 0.98))
def test_a_bus_that_is_not_full_is_never_a_flood(share: float) -> None:
    listen(BusWatch(BUS), 3.0, share * WIRE_PER_S)


def test_what_waited_while_nobody_listened_is_no_flood() -> None:
    watch = BusWatch(BUS)
    listen(watch, 1.0, OWN_PER_S)
    for _ in range(round(5.0 * OWN_PER_S)):
        watch.take(FRAME)
    watch.judge(6.0)
    listen(watch, 1.0, OWN_PER_S, from_s=6.0)


def test_what_waited_while_nobody_listened_and_is_read_round_by_round_is_no_flood() -> None:
    watch = BusWatch(BUS)
    listen(watch, 1.0, OWN_PER_S)
    caught_up_s = catch_up(watch, round(5.0 * OWN_PER_S), from_s=6.0)
    listen(watch, 1.0, OWN_PER_S, from_s=caught_up_s)


def test_what_waited_for_a_process_that_was_suspended_while_it_read_is_no_flood() -> None:
    watch = BusWatch(BUS)
    listen(watch, 1.0, OWN_PER_S)
    watch.take(stamped(1.02))
    for _ in range(watch.most_at_once - 1):
        watch.take(stamped(6.0))
    watch.judge(1.02)
    caught_up_s = catch_up(watch, round(5.0 * OWN_PER_S) - watch.most_at_once, from_s=6.0)
    listen(watch, 1.0, OWN_PER_S, from_s=caught_up_s)


def test_a_flood_after_a_pause_is_noticed_once_nothing_waits_any_more() -> None:
    watch = BusWatch(BUS)
    listen(watch, 1.0, OWN_PER_S)
    caught_up_s = catch_up(watch, round(60.0 * OWN_PER_S), from_s=61.0)
    with pytest.raises(DriverError) as caught:
        listen(watch, 1.0, 0.9 * WIRE_PER_S, from_s=caught_up_s)
    assert caught.value.fault is FaultKind.BUS_FLOODED


def test_what_waited_before_the_first_round_is_no_flood() -> None:
    watch = BusWatch(BUS)
    for _ in range(watch.most_at_once):
        watch.take(FRAME)
    watch.judge(10.0)


def test_a_short_burst_is_borne() -> None:
    watch = BusWatch(BUS)
    watch.judge(0.0)
    for _ in range(round(BURST_S * FULLEST * WIRE_PER_S)):
        watch.take(FRAME)
    watch.judge(TICK_S)


def test_after_a_flood_has_been_told_the_bus_counts_as_well_until_the_next() -> None:
    watch = BusWatch(BUS)
    with pytest.raises(DriverError):
        listen(watch, 1.0, WIRE_PER_S)
    listen(watch, 5.0, OWN_PER_S, from_s=1.0)


def test_error_frames_again_and_again_are_a_disturbed_bus() -> None:
    with pytest.raises(DriverError, match=f"error frames, limit {MOST_ERRORS} a second") as caught:
        listen(BusWatch(BUS), 2.0, 5 * MOST_ERRORS, ERROR)
    assert caught.value.fault is FaultKind.BUS_GARBLED


def test_a_few_error_frames_are_borne_for_ever() -> None:
    listen(BusWatch(BUS), 60.0, MOST_ERRORS / 2, ERROR)


def test_a_controller_that_has_left_the_bus_is_told_at_once() -> None:
    with pytest.raises(DriverError, match="bus-off") as caught:
        BusWatch(BUS).take(OFF)
    assert caught.value.fault is FaultKind.BUS_OFF


def test_a_flood_is_not_swallowed_whole() -> None:
    """So many frames are taken at once that the bucket runs over with them, and no more."""
    watch = BusWatch(BUS)
    watch.judge(0.0)
    for _ in range(watch.most_at_once):
        watch.take(FRAME)
    with pytest.raises(DriverError):
        watch.judge(TICK_S)
