"""A journal of a short mission, made by hand."""

from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from pathlib import Path

import pytest

from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.messages import Bound, Evidence
from states.names import Event

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
TRACKING, COASTING, EXIT = "Forward.Follow.Tracking", "Forward.Follow.Coasting", "Forward.Exit"
ENDED = Evidence("probability of an end", 0.52, 0.5, fires=Event.LANE_ENDED)
COASTED = Evidence("coasted", 2.6, 2.5, "m", Event.FAIL, Bound.ABOVE, alone=True)
SHORT = (
    Entry(0.4, "start", "Idle", "Checking", 1, 0, forward_m=0.0, sideways_m=0.0),
    Entry(0.5, "ready", "Checking", "Forward.Follow.Acquiring", 1, 0, forward_m=0.0, sideways_m=0.0),
    Entry(1.0, "rows found", "Forward.Follow.Acquiring", TRACKING, 1, 3, forward_m=0.1, sideways_m=0.0),
    Entry(
        8.0,
        "held by the gate",
        TRACKING,
        TRACKING,
        1,
        3,
        reason="camera black: front",
        forward_m=3.0,
        sideways_m=0.0,
    ),
    Entry(20.04, "lane ended", TRACKING, EXIT, 1, 3, (ENDED,), forward_m=9.0, sideways_m=0.0),
    Entry(
        25.0,
        "rows seen again",
        EXIT,
        COASTING,
        1,
        3,
        reason="crop comes again",
        forward_m=11.0,
        sideways_m=0.0,
    ),
    Entry(
        30.0,
        "fail",
        COASTING,
        "Fault.Recoverable",
        1,
        3,
        (COASTED,),
        reason="rows lost",
        forward_m=13.6,
        sideways_m=0.0,
    ),
)
"""From the start to a stop."""

Written = Callable[[Sequence[Entry]], RunDirectory]


@pytest.fixture
def written(tmp_path: Path) -> Written:
    """Writes entries into a run's directory."""

    def write(entries: Sequence[Entry] = SHORT) -> RunDirectory:
        directory = RunDirectory.create(tmp_path, "demo", START)
        with Journal(directory.journal, START) as journal:
            for entry in entries:
                journal.record(entry)
        return directory

    return write


@pytest.fixture
def mission() -> tuple[Entry, ...]:
    """The entries of a mission from its start to a stop."""
    return SHORT
