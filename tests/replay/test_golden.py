"""Golden runs: recorded once, replayed on every change of the program."""

import lzma
import shutil
from pathlib import Path

import pytest

from fieldnav.cli.replay_report import said
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.resolved import read_settings
from fieldnav.replay.difference import Difference, Kind, Replayed
from fieldnav.replay.replay import replay

GOLDEN = Path(__file__).parent.parent / "golden"
RUNS = sorted(path.parent.name for path in GOLDEN.glob("*/recording.mcap.xz"))
SAME_S = 0.3
"""Two pictures of a golden run: processors and versions of OpenCV round differently."""


def unpacked(name: str, folder: Path) -> RunDirectory:
    """A golden run as a run's directory."""
    directory = RunDirectory(shutil.copytree(GOLDEN / name, folder / name))
    packed = directory.recording.with_name("recording.mcap.xz")
    directory.recording.write_bytes(lzma.decompress(packed.read_bytes()))
    return directory


def moved(done: Replayed) -> list[Difference]:
    """The transitions that came out otherwise."""
    gone = (Kind.MISSING, Kind.ADDED)
    return [each for each in done.differences if each.kind in gone or abs(each.later_s or 0) > SAME_S]


def readable(differences: list[Difference]) -> str:
    """A line for each, as a person reads them."""
    return "\n".join(
        f"{each.line.stamp_s:7.2f} s  lane {each.line.lane}  {each.line.event}: "
        f"{each.line.source} -> {each.line.target}: {said(each)}"
        for each in differences
    )


@pytest.mark.parametrize("name", RUNS)
def test_a_golden_run_makes_the_transitions_that_it_made(name: str, tmp_path: Path) -> None:
    directory = unpacked(name, tmp_path)

    done = replay(directory, read_settings(directory.settings))

    assert done.transitions > 5
    assert not moved(done), f"{name} came out otherwise (see tests/golden/make.py):\n{readable(moved(done))}"


def test_a_change_of_a_threshold_is_told_in_a_readable_way(tmp_path: Path) -> None:
    directory = unpacked("gap", tmp_path)
    then = read_settings(directory.settings)
    further = then.crop.switching.model_copy(update={"headland_m": then.crop.switching.headland_m + 0.1})
    changed = type(then)(then.crop.model_copy(update={"switching": further}), then.robot, then.options)

    told = readable(moved(replay(directory, then, changed)))

    assert "last lane left: Forward.Exit -> Finished: missing" in told
