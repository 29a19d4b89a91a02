"""A folder of runs, what `fieldnav log` prints, and a run that leaves a lane and latches."""

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.summary import LoopHealth, write_summary

from .made import figures, journalled, record
from .made_latched import LATCHED
from .made_stuck import STUCK, every_frame

Printed = Callable[[], str]
Made = Callable[..., RunDirectory]


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Printed:
    return lambda: capsys.readouterr().out


@pytest.fixture
def runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where runs are looked for; it is not there yet."""
    monkeypatch.chdir(tmp_path)
    return tmp_path / "runs"


@pytest.fixture
def made(runs: Path) -> Made:
    """Makes a run of these entries, with its summary, in the folder `runs`."""

    def make(name: str = "demo", entries: Sequence[Entry] = LATCHED) -> RunDirectory:
        directory = journalled(runs, name, entries)
        loop = LoopHealth(rounds=1175, late_p99_ms=2.5, late_max_ms=9.5)
        write_summary(directory.summary, figures(loop=loop))
        return directory

    return make


@pytest.fixture
def directory(runs: Path) -> RunDirectory:
    """A run in the folder `runs` that leaves a lane, and whose steering is then stuck."""
    return journalled(runs, "demo", STUCK)


@pytest.fixture
def recorded(directory: RunDirectory) -> RunDirectory:
    """The same with a recording of every frame of the front camera."""
    record(directory, every_frame())
    return directory
