"""What `fieldnav simulate` says at the end: how the run ended, and why when it did not end well."""

from datetime import UTC, datetime
from pathlib import Path

import pytest
from rich.console import Console

from fieldnav.cli.mission_report import outcome_of, report, succeeded
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.journal.summary import CrossTrack, Heading, Lanes, Summary, Switches, Truth, write_summary

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)


def summary(completed: bool, missed: int | None) -> Summary:
    """Figures of a run; without ground truth when `missed` is None."""
    figures = CrossTrack(mean=1.0, std=0.5, p95=2.0, max=3.0)
    truth = missed is not None and Truth(
        cross_track_cm=figures,
        heading_deg=Heading(mean=1.0, std=0.5, max=2.0),
        crop_plants_run_over=0,
        lanes_missed=missed,
        lanes_repeated=0,
    )
    return Summary(
        completed=completed,
        lanes=Lanes(done=3 if completed else 1, total=3),
        distance_m=42.0,
        duration_s=90.0,
        wall_s=30.0,
        realtime_factor=3.0,
        transitions=20,
        faults=0 if completed else 1,
        switches=Switches(attempted=2, succeeded=2),
        truth=truth or None,
    )


@pytest.fixture
def directory(tmp_path: Path) -> RunDirectory:
    made = RunDirectory.create(tmp_path, "demo", START)
    with Journal(made.journal, START) as journal:
        journal.record(Entry(0.0, "ready", "Checking", "Forward.Follow.Acquiring"))
        journal.record(
            Entry(9.0, "fail", "Forward.Exit", "Fault.Recoverable", reason="rear [/camera] silent")
        )
    return made


def printed(directory: RunDirectory, figures: Summary) -> dict[str, str]:
    """The table's lines by their first column."""
    write_summary(directory.summary, figures)
    console = Console(width=200)
    with console.capture() as captured:
        console.print(report(directory, figures))
    lines = [line.split("  ", maxsplit=1) for line in captured.get().splitlines() if line.strip()]
    return {first: rest.strip() for first, rest in lines}


@pytest.mark.parametrize(
    ("completed", "missed", "words", "good"),
    [
        (True, 0, "finished", True),
        (True, None, "finished", True),
        (True, 1, "finished, but 1 lane was missed", False),
        (True, 2, "finished, but 2 lanes were missed", False),
        (False, 0, "stopped before the end", False),
        (False, 2, "stopped before the end", False),
    ],
)
def test_a_run_is_good_when_it_finished_and_missed_no_lane(
    completed: bool, missed: int | None, words: str, good: bool
) -> None:
    figures = summary(completed, missed)

    assert (outcome_of(figures), succeeded(figures)) == (words, good)


def test_a_stopped_run_says_where_and_why(directory: RunDirectory) -> None:
    lines = printed(directory, summary(completed=False, missed=2))

    assert lines["outcome"] == "stopped before the end"
    assert lines["stopped in"] == "Fault.Recoverable"
    assert lines["reason"] == "rear [/camera] silent"
    assert lines["lanes"] == "1 of 3"


def test_a_finished_run_has_no_reason_but_its_missed_lanes(directory: RunDirectory) -> None:
    lines = printed(directory, summary(completed=True, missed=1))

    assert "reason" not in lines and "stopped in" not in lines
    assert lines["outcome"] == "finished, but 1 lane was missed"
    assert lines["lanes missed, repeated"] == "1, 0"


def test_a_run_that_never_drove_within_the_rows_has_no_errors_to_tell(directory: RunDirectory) -> None:
    figures = summary(completed=False, missed=3)
    nothing = CrossTrack(mean=None, std=None, p95=None, max=None)
    assert figures.truth is not None
    truth = figures.truth.model_copy(update={"cross_track_cm": nothing})

    lines = printed(directory, figures.model_copy(update={"truth": truth}))

    assert lines["cross-track error"] == "unknown: nothing was driven within the rows"
    assert not any("None" in line for line in lines.values())


def test_on_a_robot_nothing_is_said_of_what_nobody_knows(directory: RunDirectory) -> None:
    assert "cross-track error" not in printed(directory, summary(completed=True, missed=None))
