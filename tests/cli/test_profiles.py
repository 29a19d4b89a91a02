"""`fieldnav profiles` and the way every command ends: a status, and one line when something is wrong."""

import json
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

import pytest
import yaml

from fieldnav import __version__
from fieldnav.cli.app import run
from fieldnav.settings.kinds import Kind, names_of
from fieldnav.settings.loading import load_crop, load_robot

Printed = Callable[[], tuple[str, str]]


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Printed:
    def read() -> tuple[str, str]:
        captured = capsys.readouterr()
        return captured.out, captured.err

    return read


def test_the_list_names_every_shipped_file(printed: Printed) -> None:
    assert run(["profiles", "list"]) == 0

    out, _ = printed()
    words = set(out.split())
    assert {name for kind in Kind for name in names_of(kind)} <= words
    assert all(len(line) <= 120 for line in out.splitlines() if line.strip() == line)


def test_the_list_is_json_for_programs(printed: Printed) -> None:
    assert run(["profiles", "list", "--json"]) == 0

    assert json.loads(printed()[0]) == {kind.value: names_of(kind) for kind in Kind}


def test_what_show_prints_is_a_file_that_gives_the_same_settings(printed: Printed, tmp_path: Path) -> None:
    assert run(["profiles", "show", "sugar-beet"]) == 0
    out, _ = printed()
    mine = tmp_path / "mine.yaml"
    mine.write_text(out)

    assert load_crop(mine) == load_crop("sugar-beet")
    assert "profiles show sugar-beet --kind field" in out


def test_show_takes_the_users_own_file_and_finds_out_its_kind(printed: Printed, tmp_path: Path) -> None:
    mine = tmp_path / "mine.yaml"
    mine.write_text((files("config") / "robots" / "thorvald.yaml").read_text())

    assert run(["profiles", "show", str(mine), "--json"]) == 0

    assert json.loads(printed()[0]) == load_robot("thorvald").model_dump(mode="json")


def test_a_field_is_shown_when_the_field_is_asked_for(printed: Printed) -> None:
    assert run(["profiles", "show", "beans", "--kind", "field"]) == 0

    assert yaml.safe_load(printed()[0])["length_m"] == 52


def test_validate_says_of_each_file_whether_it_is_right(printed: Printed, tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text("name: wrong\ncrop: beans\nlanes: 0\nlength_m: 12\n")

    assert run(["profiles", "validate", "demo", str(wrong), "maize"]) == 2

    out, error = printed()
    assert out == "demo: a valid field\nmaize: a valid crop\n"
    assert error == f"error: {wrong}: lanes: 0 is not allowed; allowed is a whole number from 1 to 100\n"


def test_every_shipped_file_is_valid(printed: Printed) -> None:
    names = [name for kind in Kind for name in names_of(kind)]

    assert run(["profiles", "validate", *names]) == 0

    assert printed()[1] == ""


WRONG = {
    "an unknown profile": (["profiles", "show", "sugarbeet"], "did you mean 'sugar-beet'?"),
    "a missing file": (["profiles", "show", "none.yaml"], "none.yaml: there is no such file"),
    "an unknown command": (["plough"], "plough"),
    "an unknown option": (["profiles", "list", "--knd", "crop"], "--knd"),
    "an unknown choice": (
        ["profiles", "list", "--kind", "cow"],
        "'cow' is not one of 'crop', 'robot', 'field'",
    ),
    "a missing argument": (["profiles", "show"], "profiles show --help"),
    "an unknown run": (["log", "show", "nothing", "--runs", "nowhere"], "no run 'nothing' in nowhere"),
    "an unknown crop": (["simulate", "demo", "--crop", "sugarbeet"], "did you mean 'sugar-beet'?"),
    "an unknown field": (["simulate", "dmo"], "did you mean 'demo'?"),
}


@pytest.mark.parametrize(("arguments", "part"), WRONG.values(), ids=WRONG.keys())
def test_wrong_input_is_one_line_and_status_2(
    arguments: list[str], part: str, printed: Printed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)

    assert run(arguments) == 2

    out, error = printed()
    assert out == ""
    assert error.startswith("error: ")
    assert error.count("\n") == 1
    assert part in error
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("group", [[], ["profiles"], ["log"]])
def test_a_group_without_a_command_shows_its_help(group: list[str], printed: Printed) -> None:
    assert run(group) == 2

    out, error = printed()
    assert "Usage: fieldnav" in out
    assert error == ""


@pytest.mark.parametrize(
    "command", ["simulate", "detect", "diagram", "log list", "log show", "profiles list", "profiles validate"]
)
def test_every_command_explains_itself(command: str, printed: Printed) -> None:
    assert run([*command.split(), "--help"]) == 0

    assert f"Usage: fieldnav {command}" in printed()[0]


def test_the_version_is_the_packages(printed: Printed) -> None:
    assert run(["--version"]) == 0

    assert printed()[0] == f"fieldnav {__version__}\n"
