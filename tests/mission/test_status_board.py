"""The status tells how the mission stands now, whatever the ticks brought."""

import json
from dataclasses import replace
from math import nan

import pytest

from fieldnav.errors import FieldnavError
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import Direction, Motion, Twist
from fieldnav.mission.gate import Passed
from fieldnav.mission.status_board import LONGEST_TEXT, MOST_WARNINGS, StatusBoard
from fieldnav.mission.tick import Tick
from fieldnav.operator.request import Answer, Command
from fieldnav.operator.status import Status
from fieldnav.operator.wire import (
    LONGEST_ANSWER_BYTES,
    LONGEST_REQUEST_BYTES,
    answer_line,
    read_answer,
    request_line,
)
from states.behaviour import Step
from states.names import Follow, Phase
from states.table import CHECKING, PAUSED

TRACKING = (Direction.FORWARD, Phase.FOLLOW, Follow.TRACKING)


def tick(now_s: float, forward_m: float = 0.0) -> Tick:
    driving = Passed(Motion(Twist(0.3, 0.4)), {})
    return Tick(now_s, TRACKING, None, Step(), driving, 2, 3, 0, forward_m, 0.0)


@pytest.fixture
def board() -> StatusBoard:
    return StatusBoard("20260501T083000Z-bonnbot", lanes=4)


def test_before_the_first_tick_there_is_a_status_too(board: StatusBoard) -> None:
    assert board.status(0.0).state == "Idle"


def test_it_tells_state_lane_distance_and_speed(board: StatusBoard) -> None:
    for forward_m in (1.0, 1.5, 1.2):
        board.watch(tick(10.0 + forward_m, forward_m))
    status = board.status(14.0, battery_percent=81.0, lateness_s=0.003)
    assert (status.state, status.lane, status.lanes, status.rows) == ("Forward.Follow.Tracking", 2, 4, 3)
    assert [status.since_s, status.distance_m, status.speed_mps] == pytest.approx([3.0, 0.8, 0.5])
    assert (status.battery_percent, status.lateness_s) == (81.0, 0.003)


def test_wheels_that_only_turn_into_place_have_no_speed(board: StatusBoard) -> None:
    board.watch(replace(tick(1.0), passed=Passed(Motion(Twist(0.3), hold=True), {})))
    assert board.status(1.0).speed_mps == 0.0


def test_the_reason_is_that_of_the_state_until_the_gate_has_one(board: StatusBoard) -> None:
    board.watch(replace(tick(1.0), state=CHECKING))
    board.watch(replace(tick(2.0), state=PAUSED, step=Step(reason="the operator's wish")))
    board.watch(replace(tick(3.0), state=PAUSED))
    assert board.status(5.0).reason == "the operator's wish"
    assert board.status(5.0).since_s == 3.0

    assert board.status(5.0, because="paused by the operator").reason == "paused by the operator"

    late = Trouble(FaultKind.FRAMES_LATE, "newest frame is 0.60 s old")
    board.watch(replace(tick(6.0), state=PAUSED, passed=Passed(Motion(), {}, late)))
    assert board.status(6.0).reason == "frames late: newest frame is 0.60 s old"


def test_warnings_are_kept_once_each_and_the_newest_of_many(board: StatusBoard) -> None:
    for number in (*range(MOST_WARNINGS + 3), 5):
        board.watch(replace(tick(1.0), warning=f"warning {number}"))
    warnings = board.status(1.0).warnings
    assert len(warnings) == MOST_WARNINGS
    assert warnings[0] == "warning 3" and warnings[-1] == "warning 5"


def test_the_fullest_status_goes_over_the_line_and_back(board: StatusBoard) -> None:
    for number in range(MOST_WARNINGS):
        board.watch(
            replace(tick(1.0), warning=f"{number}{'ä' * 2 * LONGEST_TEXT}", step=Step(reason="x" * 999))
        )
    answer = Answer(True, "well", board.status(1.0, battery_percent=50.0))
    said = answer_line(answer)
    assert len(said) < LONGEST_ANSWER_BYTES
    assert read_answer(said) == answer


def test_a_figure_that_is_no_number_is_unknown_and_leaves_the_line_readable(board: StatusBoard) -> None:
    board.watch(tick(1.0, forward_m=nan))
    board.watch(tick(1.1, forward_m=0.0))
    said = answer_line(Answer(True, "", board.status(nan, battery_percent=nan, lateness_s=nan)))
    assert b"NaN" not in said
    status = read_answer(said).status
    assert status is not None
    assert (status.since_s, status.distance_m, status.battery_percent, status.lateness_s) == (None,) * 4


def test_a_name_that_is_no_unicode_can_be_told(board: StatusBoard) -> None:
    said = answer_line(Answer(False, "run \udc80", Status("\udc80", "Idle", None, 0, 1, 0, 0.0, 0.0)))
    assert read_answer(said).said == "run ?"


@pytest.mark.parametrize(
    "said", [b"", b"{}", b"[]", b'{"ok": true}', b'{"ok": true, "said": "", "status": 1}']
)
def test_an_answer_of_something_else_is_one_clear_line(said: bytes) -> None:
    with pytest.raises(FieldnavError, match="is not understood; is it of another version"):
        read_answer(said)


def test_a_later_versions_further_keys_are_passed_over() -> None:
    assert read_answer(b'{"ok": false, "said": "no", "mood": "fine"}') == Answer(False, "no")


@pytest.mark.parametrize("command", Command)
def test_every_request_is_one_short_line_of_json(command: Command) -> None:
    line = request_line(command)
    assert json.loads(line) == {"command": command.value}
    assert line.count(b"\n") == 1 and len(line) < LONGEST_REQUEST_BYTES
