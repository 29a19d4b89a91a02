"""Makes runs for the report's tests."""

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry

from .made_run import STORY, written

RunMaker = Callable[..., RunDirectory]


@pytest.fixture
def make_run(tmp_path: Path) -> RunMaker:
    """A maker of runs: of the story, or of other lines; recorded or not; with a summary or broken off."""

    def make(
        lines: Sequence[Entry] = STORY,
        recorded: bool = False,
        completed: bool | None = False,
        name: str = "story",
        until_s: float | None = None,
    ) -> RunDirectory:
        return written(tmp_path / "runs", lines, recorded, completed, name, until_s)

    return make
