"""`fieldnav simulate` with wrong input: one line that helps, status 2, and no run directory."""

from importlib.resources import files
from pathlib import Path

import pytest

from fieldnav.cli.app import run


@pytest.fixture
def parent(tmp_path: Path) -> Path:
    return tmp_path / "runs"


def refused(arguments: list[str], parent: Path, capsys: pytest.CaptureFixture[str]) -> str:
    """The one line that a run which must not begin leaves behind."""
    assert run(["simulate", *arguments, "--out", str(parent)]) == 2
    captured = capsys.readouterr()
    lines = captured.err.splitlines()
    assert captured.out == "" and len(lines) == 1, captured
    assert not parent.exists(), "nothing half-written is left behind"
    return lines[0]


def changed_field(folder: Path, old: str, new: str) -> str:
    text = (files("config") / "fields" / "demo.yaml").read_text(encoding="utf-8")
    assert old in text
    path = folder / "mine.yaml"
    path.write_text(text.replace(old, new))
    return str(path)


def test_an_unknown_crop(parent: Path, capsys: pytest.CaptureFixture[str]) -> None:
    line = refused(["demo", "--crop", "sugar-beat"], parent, capsys)

    assert "unknown crop 'sugar-beat'" in line and "did you mean 'sugar-beet'" in line and "potato" in line


def test_an_unknown_field_and_an_unknown_robot(parent: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "unknown field 'dema': did you mean 'demo'" in refused(["dema"], parent, capsys)
    assert "unknown robot 'bonbot': did you mean 'bonnbot'" in refused(["--robot", "bonbot"], parent, capsys)


def test_a_misspelt_key(parent: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = changed_field(tmp_path, "lanes: 3", "lans: 3")

    line = refused([path], parent, capsys)

    assert path in line and "lans: 3" in line and "did you mean 'lanes'" in line


def test_a_number_out_of_bounds(parent: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = changed_field(tmp_path, "length_m: 12", "length_m: 3")

    line = refused([path], parent, capsys)

    assert f"{path}: length_m: 3 is not allowed; allowed is a number from 4 to 2000" in line


@pytest.mark.parametrize(
    ("option", "value", "said"),
    [
        ("--lanes", "0", "error: --lanes: 0 is not allowed; allowed is a whole number from 1 to 100"),
        ("--length", "3.5", "error: --length: 3.5 is not allowed; allowed is a number from 4 to 2000"),
        ("--length", "nan", "error: --length: NaN is not allowed"),
        ("--seed", "-1", "error: --seed: -1 is not allowed; allowed is a whole number from 0 to 2147483647"),
        ("--lanes", "few", "'--lanes'"),
        ("--side", "up", "'up' is not one of 'right', 'left'"),
    ],
)
def test_an_option_out_of_bounds(
    option: str, value: str, said: str, parent: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert said in refused(["demo", option, value], parent, capsys)


def test_a_missing_file(parent: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for option in ([], ["demo", "--crop"], ["demo", "--robot"]):
        path = str(tmp_path / "nowhere.yaml")
        assert f"{path}: there is no such file" in refused([*option, path], parent, capsys)


def test_a_field_whose_lanes_are_too_close(
    parent: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = changed_field(tmp_path, "seed: 1", "lane_pitch_m: 1.1")

    assert "lane_pitch_m 1.1 is too small for crop sugar-beet" in refused([path], parent, capsys)


def test_a_bend_too_tight_for_the_lanes(
    parent: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = changed_field(tmp_path, "lanes: 3", "lanes: 30\nrows: { shape: curved, radius_m: 9 }")

    assert "lanes: 30 lanes of 1.5 m do not fit a bend" in refused([path], parent, capsys)


def test_an_output_folder_that_cannot_be_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    in_the_way = tmp_path / "file"
    in_the_way.write_text("not a folder")

    line = refused(["demo"], in_the_way / "runs", capsys)

    assert str(in_the_way / "runs") in line and "allowed is a folder you can write" in line
    assert in_the_way.read_text() == "not a folder"


def test_a_field_of_millions_of_plants(parent: Path, capsys: pytest.CaptureFixture[str]) -> None:
    line = refused(["demo", "--lanes", "100", "--length", "2000"], parent, capsys)

    assert "lanes 100 of length_m 2000 hold about 3933633 plants" in line and "at most 400000" in line


def test_a_robot_whose_camera_looks_too_far_up(
    parent: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (files("config") / "robots" / "bonnbot.yaml").read_text(encoding="utf-8")
    path = tmp_path / "mine.yaml"
    path.write_text(text.replace("tilt_deg: 65", "tilt_deg: 5"))

    line = refused(["demo", "--robot", str(path)], parent, capsys)

    assert f"{path}: cameras.front.tilt_deg: 5 is not allowed; allowed is a number from 10 to 90" in line


def test_a_name_too_long_for_a_folder(
    parent: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = changed_field(tmp_path, "name: demo", f"name: {'d' * 300}")

    assert f"{path}: name: 'ddd" in refused([path], parent, capsys)
    assert "File name too long" in refused(["demo"], parent / ("x" * 300), capsys)
