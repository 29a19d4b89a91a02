"""`fieldnav log why` by the journal: which moment is meant, the cause, what was judged, what was near."""

from collections.abc import Callable

import pytest

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.messages import Bound, Evidence
from states.names import Event

from .made import EXIT, START

Printed = Callable[[], str]


@pytest.mark.usefixtures("directory")
@pytest.mark.parametrize(
    ("arguments", "first"),
    [
        ([], "stopped at 0:45.0 in lane 1, Forward.Exit -> Fault.Latched: steering stuck: module front_left"),
        (["last"], "stopped at 0:45.0"),
        (
            ["demo", "2"],
            "lane ended at 0:40.0 in lane 1, Forward.Follow.Tracking -> Forward.Exit: probability",
        ),
        (["2"], "lane ended at 0:40.0"),
        (["40.3"], "lane ended at 0:40.0"),
        (["0:40"], "lane ended at 0:40.0"),
        (["41s"], "lane ended at 0:40.0"),
        (["last", "20.0"], "nothing changed at 0:20.0 in lane 1, Forward.Follow.Tracking since 0:01.0"),
    ],
)
def test_run_and_moment_are_told_apart(arguments: list[str], first: str, printed: Printed) -> None:
    assert run(["log", "why", *arguments]) == 0

    assert printed().splitlines()[0].startswith(first)


@pytest.mark.usefixtures("directory")
def test_without_a_recording_the_journal_tells_what_it_can_and_says_so(printed: Printed) -> None:
    assert run(["log", "why", "2"]) == 0

    text = printed()
    assert "what Forward.Follow.Tracking judged" in text
    (ended,) = (line.split() for line in text.splitlines() if line.startswith("probability "))
    assert ended == ["probability", "0.51", ">=", "0.5", "+0.01", "lane", "ended"]
    (lost,) = (line.split() for line in text.splitlines() if line.startswith("rows lost"))
    assert lost == ["rows", "lost", "1.5", "rows", "rows", "seen", "3", ">", "1.5", "rows"]
    assert "this run has no recording: the journal alone is shown" in text
    before, here, after = (line.split()[:3] for line in text.splitlines()[-3:])
    assert (before, here, after) == (
        ["before", "1", "0:01.0"],
        ["here", "2", "0:40.0"],
        ["after", "3", "0:45.0"],
    )


@pytest.mark.usefixtures("directory")
def test_a_stop_is_followed_by_what_to_look_at(printed: Printed) -> None:
    assert run(["log", "why"]) == 0

    _, advice, meaning, *_ = printed().splitlines()
    assert advice == "look at: look for a stone or a stalk"
    assert meaning == "steering stuck means: a wheel's angle does not follow its set-point"


@pytest.mark.usefixtures("directory")
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["last", "noon"], "'noon': is no moment of a run; allowed is a line's number such as 17, or a time"),
        (["last", "17"], "no line 17 in the journal; allowed is 0 to 3"),
        (["nowhere"], "no run 'nowhere' in runs"),
    ],
)
def test_what_cannot_be_answered_is_one_line(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["log", "why", *arguments]) == 2

    captured = capsys.readouterr()
    assert captured.out == "" and said in captured.err


def test_a_stop_that_follows_at_once_shows_what_led_to_it(directory: RunDirectory, printed: Printed) -> None:
    beside = Evidence("rows where the wheels will go", 1, 0, "rows", bound=Bound.AT_MOST)
    looks = Evidence("looks for the next lane", 2, 2, "looks", Event.FAIL, alone=True)
    with Journal(directory.journal, START) as journal:
        journal.record(Entry(60.0, "lane refused", EXIT, "Forward.Sidestep.Returning", 1, 3, (beside,)))
        journal.record(
            Entry(60.02, "fail", "Forward.Sidestep.Returning", "Fault.Recoverable", 1, 3, (looks,))
        )

    assert run(["log", "why"]) == 0
    assert "what Forward.Exit had judged just before, at 1:00.0" in printed()

    assert run(["log", "why", "2"]) == 0
    assert "had judged just before" not in printed(), "the line before came long before"


def test_a_count_that_was_just_reached_is_told_from_one_that_just_was_not(
    directory: RunDirectory, printed: Printed
) -> None:
    looks = Evidence("looks", 2, 2, "looks", Event.FAIL, alone=True)
    rows = Evidence("rows", 3, 3, "rows", Event.ROWS_FOUND, Bound.ABOVE)
    with Journal(directory.journal, START) as journal:
        journal.record(Entry(60.0, "fail", EXIT, "Fault.Recoverable", 1, 3, (rows, looks)))

    assert run(["log", "why"]) == 0

    judged = [line.split() for line in printed().splitlines() if line.startswith(("looks", "rows"))]
    assert judged[0] == ["looks", "2", "looks", ">=", "2", "just", "met", "fail,", "alone"]
    assert judged[1] == ["rows", "3", "rows", ">", "3", "just", "not", "rows", "found"]
    assert judged[2] == ["rows", "found", "just", "not", "rows", "3", "<=", "3", "rows"]
