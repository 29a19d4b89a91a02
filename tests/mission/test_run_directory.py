"""The directory of a run: the mission stops where it is deleted, and a run that is refused leaves none."""

import shutil
from pathlib import Path

import pytest

from drivers.can_log import LoggedBus
from fieldnav.errors import OutputError
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.messages import Side
from fieldnav.mission import simulated
from fieldnav.mission.simulated import Run, simulate
from fieldnav.mission.tick import Tick
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from states.names import Follow

DRIVEN_M, STOPS_WITHIN_M = 0.5, 0.3
"""The ledger has a line every quarter of a metre."""


class Deleting:
    """Deletes all runs while the robot drives, and notes how far it has come."""

    def __init__(self, runs: Path) -> None:
        self._runs = runs
        self.deleted_m: float | None = None
        self.came_m = 0.0

    def watch(self, tick: Tick) -> None:
        self.came_m = tick.forward_m
        if self.deleted_m is None and Follow.TRACKING in tick.state and tick.forward_m > DRIVEN_M:
            shutil.rmtree(self._runs)
            self.deleted_m = tick.forward_m


def short_run(parent: Path) -> Run:
    field = revised(load_field("demo"), {"lanes": 1, "length_m": 6})
    robot = smaller(load_robot("bonnbot"))
    return Run(field, load_crop(field.crop), robot, 1, Side.RIGHT, parent, sketch=True)


def test_a_run_whose_directory_is_deleted_stops_soon_and_says_so(tmp_path: Path) -> None:
    deleting = Deleting(tmp_path / "runs")

    with pytest.raises(OutputError, match="cannot be written: it was deleted"):
        simulate(short_run(tmp_path / "runs"), [deleting])

    assert deleting.deleted_m is not None
    assert deleting.came_m - deleting.deleted_m < STOPS_WITHIN_M


class Refused(LoggedBus):
    """A log that cannot be begun."""

    def __init__(self, *arguments: object) -> None:
        raise OutputError("can.log: cannot be written: No space left on device")


def test_a_run_that_is_refused_leaves_no_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simulated, "LoggedBus", Refused)

    with pytest.raises(OutputError, match="No space left"):
        simulate(short_run(tmp_path / "runs"))

    assert list((tmp_path / "runs").iterdir()) == []
