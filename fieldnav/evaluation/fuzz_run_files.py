"""The good files of a run that the fuzz begins from, each with how fieldnav reads it back."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory

from fieldnav.inquiry.outcome import overview
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal, read
from fieldnav.journal.ledger import Booking, Ledger, last_booking
from fieldnav.journal.resolved import read_settings, write_settings
from fieldnav.journal.summary import Lanes, Summary, Switches, read_summary, to_json
from fieldnav.messages import Evidence, Twist
from fieldnav.settings.loading import load_crop, load_robot

ROBOT, CROP = "bonnbot", "sugar-beet"
LINES, LEDGER = 12, "ledger.jsonl"
EPOCH = datetime(2000, 1, 1, tzinfo=UTC)
WARNINGS = ("front camera knocked: the rows show its tilt 6 degrees off",)


@dataclass(frozen=True, slots=True)
class Original:
    """A good file; `settings`: it may only be refused by SettingsError. `read` raises FieldnavError."""

    name: str
    text: str
    read: Callable[[Path], None]
    settings: bool = True

    def place_in(self, folder: Path) -> Path:
        """Where the file lies when it is read."""
        return folder / self.name


def files_of_a_run() -> list[Original]:
    """What a run writes, as it is read back."""
    with TemporaryDirectory(prefix="fieldnav-") as folder:
        run = RunDirectory(Path(folder))
        with Journal(run.journal, EPOCH) as journal:
            for number in range(LINES):
                journal.record(_entry(number))
        write_settings(run.settings, load_crop(CROP), load_robot(ROBOT), None, {"lanes": 3, "side": "right"})
        with Ledger(run.path / LEDGER) as ledger:
            for number in range(LINES):
                ledger.book(_booking(number))
        texts = {path.name: path.read_text(encoding="utf-8") for path in run.path.iterdir()}
    return [
        Original(run.journal.name, texts[run.journal.name], _read_journal, settings=False),
        Original(LEDGER, texts[LEDGER], _read_ledger, settings=False),
        Original(run.summary.name, to_json(_summary()), _read_figures, settings=False),
        Original(run.settings.name, texts[run.settings.name], _read_settings),
    ]


def _read_settings(path: Path) -> None:
    read_settings(path)


def _read_journal(path: Path) -> None:
    """Read it, tell of it, and go on writing behind it."""
    overview(RunDirectory(path.parent))
    read(path)
    with Journal(path, EPOCH) as journal:
        journal.record(_entry(LINES))


def _read_ledger(path: Path) -> None:
    last_booking(path)
    with Ledger(path) as ledger:
        ledger.book(_booking(LINES))


def _read_figures(path: Path) -> None:
    read_summary(path)


def _entry(number: int) -> Entry:
    evidence = (Evidence("crop centres ahead", number, 1.0), Evidence("rows", float("nan"), None, "m"))
    source, target, command = "Forward.Follow.Acquiring", "Forward.Follow.Tracking", Twist(0.5)
    return Entry(number * 1.5, "rows found", source, target, 1, 3, evidence, command=command)


def _booking(number: int) -> Booking:
    done = tuple(range(1, number % 3 + 1))
    return Booking(
        stamp_s=number * 0.5,
        state="Forward.Follow.Tracking",
        side="right",
        lanes=3,
        lane=len(done) + 1,
        done=done,
        rows=3,
        forward_m=number * 0.25,
        sideways_m=0.0,
        pitches_m=(1.5,),
    )


def _summary() -> Summary:
    return Summary(
        completed=True,
        lanes=Lanes(done=3, total=3),
        distance_m=41.2,
        duration_s=112.5,
        wall_s=18.1,
        realtime_factor=6.2,
        transitions=40,
        faults=0,
        switches=Switches(attempted=2, succeeded=2),
        warnings=WARNINGS,
    )
