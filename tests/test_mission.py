"""Whole missions: real states, driver and CAN frames, on a simulated field, to the run directory."""

import json
import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from fieldnav.cli.app import run as command
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.journal.directory import RunDirectory, find_run
from fieldnav.journal.entry import Line
from fieldnav.journal.journal import read
from fieldnav.journal.summary import Summary
from fieldnav.messages import Floats, Side
from fieldnav.mission.simulated import Run, simulate
from fieldnav.mission.tick import Tick
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Robot
from states.names import Path as StatePath
from states.table import LANE_LEAVES

MOST_APART_M = 0.05
"""What looking at mirrored pictures may change in a path, over a whole mission."""


class Watcher:
    """Notes what the mission does, tick by tick."""

    def __init__(self) -> None:
        self.states: list[StatePath] = []
        self.travelled: list[tuple[float, float]] = []
        self.moving_outside_lanes: list[StatePath] = []

    def watch(self, tick: Tick) -> None:
        if not self.states or self.states[-1] != tick.state:
            self.states.append(tick.state)
        self.travelled.append((tick.forward_m, tick.sideways_m))
        wanted = tick.step.motion.twist
        if tick.state not in LANE_LEAVES and any((wanted.vx_mps, wanted.vy_mps)) and tick.change is None:
            self.moving_outside_lanes.append(tick.state)

    def path(self) -> Floats:
        return np.array(self.travelled)


def quick_robot() -> Robot:
    """A sixteenth of the pixels of the robot's own cameras: quicker to draw and to look at."""
    return smaller(load_robot("bonnbot"), 4)


def drive(
    parent: Path, lanes: int, length_m: float, side: Side = Side.RIGHT, mirrored: bool = False
) -> tuple[RunDirectory, Summary, Watcher]:
    field = revised(load_field("demo"), {"lanes": lanes, "length_m": length_m, "mirrored": mirrored})
    watcher = Watcher()
    run = Run(field, load_crop(field.crop), quick_robot(), lanes, side, parent)
    done = simulate(run, [watcher])
    return done.directory, done.summary, watcher


def transitions(lines: list[Line]) -> list[tuple[str, str, str]]:
    return [(line.source, line.event, line.target) for line in lines]


@pytest.fixture(scope="module")
def mission(tmp_path_factory: pytest.TempPathFactory) -> tuple[RunDirectory, Summary, Watcher]:
    """Two short lanes of the demonstration field, driven once for several tests."""
    return drive(tmp_path_factory.mktemp("runs"), lanes=2, length_m=4)


@pytest.fixture(scope="module")
def mirrored(tmp_path_factory: pytest.TempPathFactory) -> tuple[RunDirectory, Summary, Watcher]:
    """The same, seen in a mirror."""
    return drive(tmp_path_factory.mktemp("runs"), lanes=2, length_m=4, side=Side.LEFT, mirrored=True)


def test_two_lanes_are_driven_and_no_plant_is_run_over(
    mission: tuple[RunDirectory, Summary, Watcher],
) -> None:
    directory, summary, watcher = mission

    assert summary.completed and summary.faults == 0
    assert summary.warnings == (), "calibration errors as they are usual are no warning"
    assert (summary.lanes.done, summary.lanes.total) == (2, 2)
    assert (summary.switches.attempted, summary.switches.succeeded) == (1, 1)
    truth = summary.truth
    assert truth is not None
    assert (truth.crop_plants_run_over, truth.lanes_missed, truth.lanes_repeated) == (0, 0, 0)
    assert truth.cross_track_cm.mean is not None and truth.cross_track_cm.mean < 6
    assert watcher.moving_outside_lanes == []
    assert find_run("last", directory.path.parent) == directory


def test_the_journal_tells_the_four_phases_in_their_order(
    mission: tuple[RunDirectory, Summary, Watcher],
) -> None:
    lines = read(mission[0].journal)
    entered = [line.target for line in lines]
    order = [
        "Checking",
        "Forward.Follow.Acquiring",
        "Forward.Follow.Tracking",
        "Forward.Exit",
        "Forward.Sidestep.Orienting",
        "Forward.Sidestep.Sampling",
        "Forward.Sidestep.Crossing",
        "Forward.Sidestep.Settling",
        "Backward.Follow.Acquiring",
        "Backward.Follow.Tracking",
        "Backward.Exit",
        "Finished",
    ]

    assert [state for state in entered if state in order] == order
    assert [line.seq for line in lines] == list(range(len(lines)))
    judged = [line for line in lines if line.event not in ("start",)]
    assert all(line.evidence for line in judged), "every transition says what it was judged by"


def test_the_run_directory_holds_everything(mission: tuple[RunDirectory, Summary, Watcher]) -> None:
    directory, summary, _ = mission

    assert {path.name for path in directory.path.iterdir()} == {
        "journal.jsonl",
        "ledger.jsonl",
        "summary.json",
        "settings.yaml",
        "can.log",
        "map.png",
    }
    assert Summary.model_validate_json(directory.summary.read_bytes()) == summary
    assert len(directory.can_log.read_text().splitlines()) > 1000


@pytest.mark.long  # parts of it in the mirror: tests/perception, tests/simulation, tests/control
def test_a_mirrored_field_gives_the_mirrored_run(
    mission: tuple[RunDirectory, Summary, Watcher], mirrored: tuple[RunDirectory, Summary, Watcher]
) -> None:
    plain, other = mission[2].path(), mirrored[2].path()

    assert transitions(read(mission[0].journal)) == transitions(read(mirrored[0].journal))
    assert abs(len(plain) - len(other)) < 0.02 * len(plain)
    both = min(len(plain), len(other))
    np.testing.assert_allclose(other[:both], plain[:both] * [1, -1], atol=MOST_APART_M)
    assert plain[-1][1] < -1.0 and other[-1][1] > 1.0, "the next lane lies to the other side"


@pytest.fixture
def open_umask() -> Iterator[None]:
    """A process that would make everything for everybody."""
    before = os.umask(0)
    yield
    os.umask(before)


def test_the_same_seed_gives_the_same_journal_and_the_same_frames_on_the_bus(
    tmp_path: Path, quick_robot_file: Path, open_umask: None, capsys: pytest.CaptureFixture[str]
) -> None:
    short = ["--lanes", "1", "--length", "4", "--robot", str(quick_robot_file)]
    arguments = ["simulate", "demo", *short, "--json"]
    runs = []
    for name in ("first", "second"):
        assert command([*arguments, "--out", str(tmp_path / name)]) == 0
        captured = capsys.readouterr()
        assert captured.err == ""
        printed = json.loads(captured.out)
        runs.append(RunDirectory(Path(printed.pop("run"))))
        assert printed == json.loads(runs[-1].summary.read_text())

    one, other = runs
    assert one.path.parent == tmp_path / "first"
    assert one.journal.read_bytes().count(b"\n") >= 4
    assert one.journal.read_bytes() == other.journal.read_bytes()
    assert one.can_log.read_bytes() == other.can_log.read_bytes()
    modes = {
        path.name: path.stat().st_mode & 0o777 for path in (one.path.parent, one.path, *one.path.iterdir())
    }
    assert {name for name, mode in modes.items() if mode == 0o700} == {"first", one.path.name}
    assert {name for name, mode in modes.items() if mode == 0o600} >= {
        *("journal.jsonl", "ledger.jsonl", "summary.json", "settings.yaml", "can.log", "map.png"),
        *("recording.mcap", "report.html"),
    }
    assert set(modes.values()) == {0o700, 0o600}, "the settings hold the passwords of the cameras"
