"""Names and reasons from strangers: nothing in them reaches the terminal as more than text on its line."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory

from .conftest import Made
from .made_latched import LATCHED

TITLE, CLEARED, C1, BIDI = "\x1b]0;owned\x07", "\x1b[2J\x1b[31m", "\x9b31m", "\u202e\u2066"
HOSTILE = f"{TITLE}{CLEARED}{C1}{BIDI}[red]a\rb\nc\x7f\udcff[/nothing]"
ESCAPED = r"[red]a\rb\nc\x7f"
NAME = HOSTILE.replace("/", "_")


@pytest.fixture
def hostile(made: Made) -> RunDirectory:
    """A run whose directory, events and reasons were named by somebody who means harm."""
    text = HOSTILE.encode(errors="replace").decode()  # UTF-8, in which a journal is, has no lone surrogate
    entries = [
        replace(entry, event=f"{entry.event}{text}" if not entry.evidence else entry.event, reason=text)
        for entry in LATCHED
    ]
    directory = made(entries=entries)
    named = directory.path.with_name(f"{directory.path.name}-{NAME}")
    shutil.move(directory.path, named)
    return RunDirectory(named)


COMMANDS = [
    ["list"],
    ["show"],
    ["show", "--tree"],
    ["show", "--json"],
    ["tail"],
    ["tail", "--json"],
    ["why"],
    ["why", "--json"],
    ["stats"],
    ["stats", "--json"],
    ["list", "--json"],
    ["plot"],
    ["report"],
    ["export", "--csv", "transitions.csv"],
]


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_nothing_but_printable_characters_is_printed(
    command: list[str], hostile: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    run(["log", *command])

    said = capsys.readouterr()
    assert (said.out + said.err).replace("\n", "").isprintable()
    if "--json" in command:
        assert (
            [json.loads(line) for line in said.out.splitlines()]
            if "tail" in command
            else json.loads(said.out)
        )


@pytest.mark.parametrize("command", [["show"], ["tail"], ["list"]], ids=" ".join)
def test_text_stays_on_its_line_and_in_its_brackets(
    command: list[str], hostile: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    run(["log", *command])

    assert ESCAPED in capsys.readouterr().out


def test_two_runs_are_compared_by_names_on_one_line(
    hostile: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["log", "diff", "last", "last"]) == 0

    (line,) = capsys.readouterr().out.splitlines()
    assert line.isprintable() and ESCAPED in line


def test_a_run_that_is_not_there_is_named_on_one_line(
    hostile: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["log", "show", f"{HOSTILE}gone"]) == 2

    (line,) = capsys.readouterr().err.splitlines()
    assert line.isprintable() and line.startswith("error: ")


def test_a_run_is_replayed_by_a_name_on_one_line(
    hostile: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["replay", str(hostile.path)]) == 2

    (line,) = capsys.readouterr().err.splitlines()
    assert line.isprintable()


def test_a_diagram_is_no_place_for_it_either(
    hostile: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    run(["diagram", "last", "--runs", str(hostile.path.parent)])

    said = capsys.readouterr()
    assert (said.out + said.err).replace("\n", "").isprintable()


def test_a_folder_of_runs_is_named_on_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(NAME).mkdir()

    run(["log", "list", "--runs", NAME])

    (line,) = capsys.readouterr().out.splitlines()
    assert line.isprintable()
