"""What a recording lacks is said: nothing is called the same that was not compared."""

from datetime import UTC, datetime

import pytest

from fieldnav.errors import FieldnavError
from fieldnav.journal.entry import Line
from fieldnav.messages import CameraName
from fieldnav.recording.records import Call, Round, Seen
from fieldnav.replay.completeness import Completeness
from fieldnav.replay.rounds import Taken

UTC_0 = datetime(2026, 5, 1, tzinfo=UTC)
LINES = {
    seq: Line(seq=seq, stamp_s=10.0 * seq, utc=UTC_0, event="ready", source="Checking", target="Checking")
    for seq in range(3)
}


def a_round(number: int, call: Call = Call.TICK, lines: tuple[int, ...] = ()) -> Taken:
    return Taken(Round(call=call, now_s=0.02 * number, number=number, lines=lines), ())


def said(*rounds: Taken) -> list[str]:
    complete = Completeness(LINES)
    for each in rounds:
        complete.take(each)
    return complete.said()


def test_a_whole_recording_lacks_nothing() -> None:
    assert said(a_round(0, Call.START, (0,)), a_round(1, lines=(1, 2)), a_round(2)) == []


def test_rounds_that_were_left_out_are_counted() -> None:
    whole = a_round(0, Call.START, (0, 1, 2))
    assert said(whole, a_round(1), a_round(4), a_round(5)) == ["2 rounds are not in the recording"]


def test_another_process_counts_its_rounds_anew() -> None:
    first, taken_up = a_round(0, Call.START, (0, 1, 2)), a_round(0, Call.TAKE_UP)
    assert said(first, a_round(1), taken_up, a_round(1, Call.START), a_round(2)) == []


def test_lines_of_the_journal_that_no_round_has_are_counted_with_the_first_of_them() -> None:
    lacking = "2 lines of the journal, the first at 0:10.0, are not in the recording"
    assert said(a_round(0, Call.START, (0,))) == [lacking]


def test_pictures_that_were_left_out_are_counted() -> None:
    seen = Seen(camera=CameraName.FRONT, sequence=1, stamp_s=0.0)
    start = a_round(0, Call.START, (0, 1, 2))
    assert said(start, Taken(a_round(1).round, (), (seen,))) == ["1 pictures are not in the recording"]


def test_a_recording_whose_beginning_gave_way_to_the_budget_is_refused() -> None:
    with pytest.raises(FieldnavError, match=r"begins at 0:00\.1, its beginning is gone"):
        said(a_round(7))


def test_files_of_two_runs_are_refused() -> None:
    with pytest.raises(FieldnavError, match="begins once more at 0:00"):
        said(a_round(0, Call.START), a_round(1), a_round(0, Call.START))


def test_a_process_that_died_before_it_started_is_no_second_beginning() -> None:
    taken_up = a_round(0, Call.TAKE_UP)
    assert said(a_round(0, Call.START, (0, 1, 2)), taken_up, taken_up, a_round(1, Call.START)) == []
