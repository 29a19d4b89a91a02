"""Runs for the tests of `fieldnav log`, made by hand: journal, summary, recording."""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.journal.summary import Lanes, Summary, Switches, write_summary
from fieldnav.messages import Evidence
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.recorder import Recorder
from fieldnav.recording.records import Record, Ticked
from fieldnav.settings.recording import RecordingSettings

START = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)
TRACKING, COASTING, EXIT = "Forward.Follow.Tracking", "Forward.Follow.Coasting", "Forward.Exit"
ALL_DISK = RecordingSettings(keep_free_gb=0)


def journalled(runs: Path, name: str, entries: Iterable[Entry], start: datetime = START) -> RunDirectory:
    """A run's directory with these entries in its journal."""
    directory = RunDirectory.create(runs, name, start)
    with Journal(directory.journal, start) as journal:
        for entry in entries:
            journal.record(entry)
    return directory


def figures(**others: Any) -> Summary:
    """Of a run that stopped in the first of three lanes, but for what is said otherwise."""
    plain = {
        "completed": False,
        "lanes": Lanes(done=0, total=3),
        "distance_m": 11.0,
        "duration_s": 23.5,
        "wall_s": 23.5,
        "realtime_factor": 1.0,
        "transitions": 3,
        "faults": 1,
        "switches": Switches(attempted=0, succeeded=0),
    }
    return Summary.model_validate(plain | others)


@dataclass(frozen=True, slots=True)
class Item:
    """A message that waits to be recorded."""

    message: Message
    picture: bool = False

    @property
    def size(self) -> int:
        return len(self.message.data)

    def messages(self) -> Iterable[Message]:
        return (self.message,)


def item(topic: Topic, stamp_s: float, record: Record) -> Item:
    """A record that waits to be recorded."""
    return Item(Message(topic, stamp_s, record.model_dump_json().encode()))


def tick(now_s: float, **others: Any) -> Ticked:
    """Of a robot that drives ahead at 0.5 m/s, but for what is said otherwise."""
    still = dict.fromkeys(("sideways_m", "x_m", "y_m", "heading_rad", "vy_mps", "yaw_rate_rps"), 0.0)
    counts = dict.fromkeys(("lane", "rows", "rows_passed"), 1)
    plain = {"now_s": now_s, "state": TRACKING, "forward_m": now_s / 2, "vx_mps": 0.5}
    return Ticked.model_validate(plain | still | counts | others)


def record(directory: RunDirectory, items: Iterable[Item]) -> None:
    """Record them one after the other, all of them."""
    with Recorder(directory, ALL_DISK, START, waits=True) as recorder:
        for each in items:
            recorder.put(each)


def a_run(runs: Path, name: str, completed: bool | None, hour: int = 8) -> RunDirectory:
    """A run whose last entry is a fault; without a summary when `completed` is None."""
    seen = (Evidence("no plant in the top half", 0.53, 0.4, "s"), Evidence("plants", 41))
    entries = (
        Entry(0.4, "ready", "Checking", "Forward.Follow.Acquiring", 1, 0),
        Entry(85.43, "lane ended", TRACKING, EXIT, 1, 3, seen),
        Entry(90.0, "fail", EXIT, "Fault.Recoverable", 1, 0, reason="rear camera silent"),
    )
    directory = journalled(runs, name, entries, START.replace(hour=hour))
    if completed is not None:
        lanes = Lanes(done=1, total=3)
        said = figures(completed=completed, lanes=lanes, distance_m=12.6, duration_s=90.0)
        write_summary(directory.summary, said)
    return directory
