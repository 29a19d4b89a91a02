"""`fieldnav replay` as a user meets it."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from fieldnav.cli.app import run
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import Side
from fieldnav.mission.simulated import Run, simulate
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> RunDirectory:
    """One short lane on small pictures."""
    field = revised(load_field("demo"), {"lanes": 1, "length_m": 4})
    robot = smaller(load_robot("bonnbot"), 4)
    parent = tmp_path_factory.mktemp("runs")
    return simulate(
        Run(field, load_crop(field.crop), robot, 1, Side.RIGHT, parent, sketch=True, record=True)
    ).directory


def test_an_unchanged_run_is_the_same_bit_for_bit(
    recorded: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["replay", "--runs", str(recorded.path.parent)]) == 0
    assert "no difference, bit for bit" in capsys.readouterr().out


def test_what_if_lists_what_moved_and_fails(
    recorded: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["replay", str(recorded.path), "--set", "switching.headland_m=0.25"]) == 1
    told = capsys.readouterr().out
    assert "last lane left" in told
    assert "earlier" in told
    assert "commands differ in" in told


def test_programs_get_one_document(recorded: RunDirectory, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["replay", str(recorded.path), "--json", "--crop", "sugar-beet"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["differences"] == []
    assert document["commands"]["rounds"] == 0


def test_settings_that_make_the_lane_invisible_end_the_comparison_in_words(
    recorded: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["replay", str(recorded.path), "--set", "vegetation.floor=0.9"]) == 1
    told = capsys.readouterr().out
    assert "rows found" in told
    assert "the replay knows too little to be where the run was" in told
    assert "latch" not in told


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ("switching.headland=1", "--set switching.headland: is no key; allowed is one of headland_m"),
        ("headland_m", "--set headland_m: has no '='; allowed is KEY=VALUE"),
        ("switching.headland_m=9", "headland_m: 9 is not allowed; allowed is a number from 0.1 to 2"),
        ("robot.limits.speed_mps=fast", "limits.speed_mps: 'fast' is not allowed"),
        ("switching.headland_m=[", "'[' is no value"),
        ("switching.headland_m=&a [*a]", "'&a [*a]' is no value"),
        ("robot.cameras.front.width_px=300", "robot.cameras.front.width_px: 300; allowed is 320, as it was"),
        ("robot.modules.front_left.node_id=77", "modules.front_left.node_id: 77; allowed is one of"),
    ],
)
def test_a_wrong_change_is_refused_in_one_line(
    change: str, said: str, recorded: RunDirectory, error: Callable[[], str]
) -> None:
    assert run(["replay", str(recorded.path), "--set", change]) == 2
    assert said in error()


def test_options_of_foreign_recordings_are_refused_for_a_run(
    recorded: RunDirectory, error: Callable[[], str]
) -> None:
    assert run(["replay", str(recorded.path), "--speed", "0.5"]) == 2
    assert "--speed" in error()


def test_a_run_without_recording_or_settings_is_refused_in_one_line(
    recorded: RunDirectory, tmp_path: Path, error: Callable[[], str]
) -> None:
    copy = RunDirectory(shutil.copytree(recorded.path, tmp_path / "copy"))
    copy.recording.unlink()

    assert run(["replay", str(copy.path)]) == 2
    assert "recording.mcap: is not there" in error()

    copy.settings.unlink()
    assert run(["replay", str(copy.path)]) == 2
    assert "settings.yaml" in error()


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("  lanes: many", "settings.yaml: options: lanes: 'many' is not allowed"),
        ("  lanes: 0", "settings.yaml: options: lanes: 0 is not allowed"),
        ("  lanes: 1\n  confirm: hats", "settings.yaml: options: confirm: 'hats'; allowed is some of"),
        ("  lanes: 1\n  confirm: [1]", "settings.yaml: options: confirm: [1] is not allowed"),
    ],
)
def test_options_that_no_run_has_are_refused_in_one_line(
    line: str, said: str, recorded: RunDirectory, tmp_path: Path, error: Callable[[], str]
) -> None:
    copy = RunDirectory(shutil.copytree(recorded.path, tmp_path / "copy"))
    text = copy.settings.read_text()
    assert "  lanes: 1\n" in text
    copy.settings.write_text(text.replace("  lanes: 1", line, 1))

    assert run(["replay", str(copy.path)]) == 2
    assert said in error()


def test_a_run_is_named_on_one_line_also_where_it_is_the_working_folder(
    recorded: RunDirectory,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(shutil.copytree(recorded.path, tmp_path / "two\nlines"))

    assert run(["replay", "."]) == 0
    assert capsys.readouterr().out.startswith(r"two\nlines: 6 transitions")


def test_no_name_at_all_is_no_recording_of_others(tmp_path: Path, error: Callable[[], str]) -> None:
    assert run(["replay", "", "--runs", str(tmp_path)]) == 2
    assert "no run ''" in error()
