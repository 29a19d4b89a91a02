"""Why the mission stopped: from the stop's own line and from the lines before it."""

from datetime import UTC, datetime

import pytest

from fieldnav.faults import FAULTS, FaultKind, Trouble
from fieldnav.inquiry.cause import cause_of, reason_of
from fieldnav.inquiry.stops import fault_of, is_stop
from fieldnav.journal.entry import Judged, Line
from fieldnav.messages import Bound

TRACKING, COASTING = "Forward.Follow.Tracking", "Forward.Follow.Coasting"
RECOVERABLE, LATCHED, PAUSED = "Fault.Recoverable", "Fault.Latched", "Paused"
COASTED = Judged(
    name="coasted", value=2.51, threshold=2.5, unit="m", fires="fail", bound=Bound.ABOVE, alone=True
)


def line(
    stamp_s: float,
    event: str,
    source: str,
    target: str,
    reason: str = "",
    evidence: tuple[Judged, ...] = (),
) -> Line:
    return Line(
        seq=round(stamp_s * 10),
        stamp_s=stamp_s,
        utc=datetime(2026, 5, 1, tzinfo=UTC),
        event=event,
        source=source,
        target=target,
        lane=2,
        reason=reason,
        evidence=evidence,
    )


LOST_TOO_LONG = line(41.3, "fail", COASTING, RECOVERABLE, "rows lost for too long", (COASTED,))
KNOCKED = line(35.2, "camera knocked", TRACKING, TRACKING, "front camera knocked: tilt 6 degrees off")


@pytest.mark.parametrize("kind", FaultKind)
def test_every_fault_is_known_again_by_the_reason_it_is_written_with(kind: FaultKind) -> None:
    stop = line(1.0, "latch", TRACKING, LATCHED, str(Trouble(kind, "this was seen")))

    assert fault_of(stop) is kind
    assert cause_of(stop, ()).advice == FAULTS[kind].advice
    assert cause_of(stop, ()).said == f"{kind.value}: this was seen"


def test_a_stop_without_a_fault_tells_its_reason_and_the_condition_that_made_it() -> None:
    cause = cause_of(LOST_TOO_LONG, ())

    assert cause.said == "rows lost for too long (coasted 2.51 > 2.5 m)"
    assert cause.fault is None and cause.advice == ""


def test_what_was_noted_shortly_before_such_a_stop_is_named_as_what_led_to_it() -> None:
    cause = cause_of(LOST_TOO_LONG, (KNOCKED,))

    assert cause.said == (
        "rows lost for too long (coasted 2.51 > 2.5 m), "
        "after camera knocked at 0:35.2: front camera knocked: tilt 6 degrees off"
    )
    assert cause.lines == (LOST_TOO_LONG, KNOCKED)


def test_a_hold_shortly_before_gives_such_a_stop_its_fault() -> None:
    held = line(38.0, "held by the gate", COASTING, COASTING, "camera black: front camera: brightness 3")

    cause = cause_of(LOST_TOO_LONG, (held,))

    assert cause.fault is FaultKind.CAMERA_BLACK
    assert "after held by the gate at 0:38.0: camera black: front camera" in cause.said


def test_what_was_noted_long_before_has_nothing_to_do_with_it() -> None:
    held = line(33.0, "held by the gate", TRACKING, TRACKING, "camera black: front camera: brightness 3")
    slow = line(5.0, "camera slow", TRACKING, TRACKING, "front camera: 5.0 frames a second")

    assert cause_of(LOST_TOO_LONG, (slow, held)) == cause_of(LOST_TOO_LONG, ())


def test_a_fault_that_the_stop_names_itself_needs_no_other() -> None:
    stuck = line(41.3, "latch", TRACKING, LATCHED, "steering stuck: module front_left stands 14 degrees off")

    assert cause_of(stuck, (KNOCKED,)) == cause_of(stuck, ())


def test_a_persons_stop_is_the_persons_whatever_was_noted_before() -> None:
    stopped = line(41.3, "fail", TRACKING, RECOVERABLE, "stopped by alice")

    assert cause_of(stopped, (KNOCKED,)).said == "stopped by alice"


def test_a_stop_of_a_mission_that_stood_already_names_what_it_stood_for() -> None:
    unplugged = line(30.0, "fail", TRACKING, RECOVERABLE, "camera unplugged: front camera cannot be read")
    noted = line(33.0, "wall clock jumped", RECOVERABLE, RECOVERABLE, "by +2.0 s")
    silent = line(35.0, "latch", RECOVERABLE, LATCHED, "module silent: module front_left")

    cause = cause_of(silent, (KNOCKED, unplugged, noted))

    assert cause.said == (
        "module silent: module front_left; "
        "it had stood since 0:30.0: camera unplugged: front camera cannot be read"
    )
    assert cause.lines == (silent, unplugged)


def test_a_stop_after_the_mission_went_on_stands_for_itself() -> None:
    paused = line(30.0, "pause", TRACKING, PAUSED, "paused by bob")
    resumed = line(33.0, "resume", PAUSED, TRACKING, "resumed by bob")

    assert "bob" not in cause_of(LOST_TOO_LONG, (paused, resumed)).said


def test_a_check_that_failed_tells_what_did_not_come_up() -> None:
    cameras = Judged(name="cameras that give frames", value=1, threshold=2, fires="ready")
    waited = Judged(
        name="waited", value=10.02, threshold=10, unit="s", fires="fail", bound=Bound.ABOVE, alone=True
    )
    failed = line(10.0, "fail", "Checking", RECOVERABLE, "cameras do not come up", (cameras, waited))

    assert reason_of(failed) == ("cameras do not come up (cameras that give frames 1 < 2, waited 10 > 10 s)")


def test_the_line_of_a_disk_that_is_full_is_a_stop_though_it_changes_no_state() -> None:
    full = line(5.0, "disk full", TRACKING, TRACKING, "disk full: journal.jsonl: cannot be written")

    assert is_stop(full)
    assert cause_of(full, ()).fault is FaultKind.DISK_FULL
