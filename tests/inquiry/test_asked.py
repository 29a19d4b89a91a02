"""What a moment of a run stands for, and the line that tells of it."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import pytest

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.asked import asked_about
from fieldnav.inquiry.headline import Kind, headline
from fieldnav.inquiry.moment import Moment
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry, Judged
from fieldnav.messages import Bound

Written = Callable[..., RunDirectory]


def test_without_a_moment_the_last_stop_is_meant(written: Written) -> None:
    asked = asked_about(written(), None)

    assert (asked.line.seq, asked.happened, asked.after) == (6, True, None)
    assert [line.seq for line in asked.before] == [0, 1, 2, 3, 4, 5]
    said = headline(asked)
    assert said.kind is Kind.STOPPED
    assert said.text == (
        "stopped at 0:30.0 in lane 1, Forward.Follow.Coasting -> Fault.Recoverable: "
        "rows lost (coasted 2.6 > 2.5 m)"
    )


def test_the_last_stop_is_meant_although_the_mission_went_on_after_it(
    written: Written, mission: Sequence[Entry]
) -> None:
    resumed = Entry(40.0, "resume", "Fault.Recoverable", "Forward.Exit", 1, reason="resumed by bob")
    finished = Entry(50.0, "last lane left", "Forward.Exit", "Finished", 1)

    assert asked_about(written([*mission, resumed, finished]), None).line.seq == 6


def test_a_mission_without_a_stop_is_asked_about_its_last_change(
    written: Written, mission: Sequence[Entry]
) -> None:
    finished = Entry(26.0, "last lane left", "Forward.Exit", "Finished", 1, 3)
    noted = Entry(26.1, "wall clock jumped", "Finished", "Finished", reason="by +2.0 s")

    asked = asked_about(written([*mission[:5], finished, noted]), None)

    assert (asked.line.seq, asked.after is not None) == (5, True)
    assert headline(asked).kind is Kind.CHANGED


def test_a_number_means_the_line_of_that_number(written: Written) -> None:
    asked = asked_about(written(), Moment(seq=4))

    assert headline(asked).text == (
        "lane ended at 0:20.0 in lane 1, Forward.Follow.Tracking -> Forward.Exit: "
        "probability of an end 0.52 > 0.5"
    )
    assert (asked.before[-1].seq, asked.after and asked.after.seq) == (3, 5)


def test_a_number_that_there_is_not_says_what_is_allowed(written: Written) -> None:
    with pytest.raises(FieldnavError, match="no line 7 in the journal; allowed is 0 to 6"):
        asked_about(written(), Moment(seq=7))


@pytest.mark.parametrize(("at_s", "number"), [(20.0, 4), (20.04, 4), (21.0, 4), (0.5, 1), (8.3, 3)])
def test_a_time_means_the_change_shortly_before_it_or_as_it_is_shown(
    written: Written, at_s: float, number: int
) -> None:
    asked = asked_about(written(), Moment(at_s=at_s))

    assert (asked.line.seq, asked.happened) == (number, True)


def test_a_change_is_meant_rather_than_a_note_beside_it(written: Written, mission: Sequence[Entry]) -> None:
    noted = replace(mission[3], stamp_s=20.5)

    assert asked_about(written([*mission[:3], mission[4], noted]), Moment(at_s=20.6)).line.seq == 3


def test_a_note_tells_in_which_state_it_was_noted(written: Written) -> None:
    said = headline(asked_about(written(), Moment(seq=3)))

    assert said.kind is Kind.NOTED
    assert said.text == (
        "held by the gate at 0:08.0 in lane 1, in Forward.Follow.Tracking: camera black: front"
    )


def test_a_time_at_which_nothing_changed_tells_what_was_nearest(written: Written) -> None:
    asked = asked_about(written(), Moment(at_s=15.0))
    judged = Judged(name="probability of an end", value=0.31, threshold=0.5, fires="lane ended")

    assert (asked.happened, asked.line.seq, asked.after and asked.after.seq) == (False, 3, 4)
    assert headline(asked, (judged,)).text == (
        "nothing changed at 0:15.0 in lane 1, Forward.Follow.Tracking since 0:08.0: "
        "nearest was lane ended, but probability of an end 0.31 < 0.5"
    )
    assert headline(asked).text.endswith("what was judged then is not written down")


def test_a_time_after_a_stop_tells_what_the_mission_stands_for(written: Written) -> None:
    said = headline(asked_about(written(), Moment(at_s=100.0)))

    assert said.kind is Kind.NOTHING
    assert said.text.endswith("Fault.Recoverable since 0:30.0: rows lost (coasted 2.6 > 2.5 m)")


def test_a_time_before_the_first_line_says_so(written: Written) -> None:
    with pytest.raises(
        FieldnavError, match=r"nothing was written down before 0:00.1; the run ends at 0:30.0"
    ):
        asked_about(written(), Moment(at_s=0.1))


def test_a_journal_without_lines_says_so(written: Written) -> None:
    with pytest.raises(FieldnavError, match="holds no line yet"):
        asked_about(written([]), None)


def test_the_comparison_shown_of_a_condition_is_the_one_that_was_made(written: Written) -> None:
    asked = asked_about(written(), Moment(at_s=15.0))
    full = Judged(name="frames", value=4, threshold=4, unit="frames", fires="fail", bound=Bound.ABOVE)

    assert headline(asked, (full,)).text.endswith("nearest was fail, but frames 4 <= 4 frames")
