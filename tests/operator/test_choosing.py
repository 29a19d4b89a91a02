"""The mission that an operator means, or one clear line that names the others."""

import os
from datetime import UTC, datetime
from pathlib import Path

import pytest

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.operator.choosing import choose, driven_in
from fieldnav.operator.socket_place import socket_path

FOLDER = Path("/run/user/1000/fieldnav")
OLD, NEW = "20260501T083000Z-bonnbot", "20260501T093000Z-thorvald"
SOCKETS = [socket_path(FOLDER, NEW), socket_path(FOLDER, OLD)]


def test_the_only_mission_needs_no_name() -> None:
    assert choose(SOCKETS[:1], None) == SOCKETS[0]


def test_of_several_one_must_be_named() -> None:
    with pytest.raises(FieldnavError) as caught:
        choose(SOCKETS, None)
    assert str(caught.value) == (
        f"several missions are running: {NEW}, {OLD}; name one with --run, or --run last"
    )


@pytest.mark.parametrize("run", [OLD, "bonnbot", f"runs/{OLD}", f"./runs/{OLD}/", f"/some/where/{OLD}"])
def test_a_mission_is_named_by_its_name_a_part_of_it_or_its_path(run: str) -> None:
    assert choose(SOCKETS, run) == SOCKETS[1]


def test_last_is_the_newest() -> None:
    assert choose(SOCKETS, "last") == SOCKETS[0]


def test_a_whole_name_goes_before_another_that_begins_with_it() -> None:
    sockets = [socket_path(FOLDER, f"{OLD}-2"), socket_path(FOLDER, OLD)]
    assert choose(sockets, OLD) == sockets[1]


def test_a_part_of_two_names_is_asked_about() -> None:
    with pytest.raises(FieldnavError, match="several missions are running"):
        choose(SOCKETS, "20260501")


@pytest.mark.parametrize("run", ["demo", "", "/"])
def test_a_mission_that_does_not_run_is_one_line_with_those_that_do(run: str) -> None:
    with pytest.raises(FieldnavError) as caught:
        choose(SOCKETS, run)
    assert str(caught.value) == f"no mission '{run}' is running; allowed is one of: {NEW}, {OLD}"


@pytest.mark.parametrize("run", [None, "last", OLD])
def test_without_any_mission_there_is_one_clear_line(run: str | None) -> None:
    with pytest.raises(FieldnavError, match="no mission is running"):
        choose([], run)


def test_a_name_too_long_for_a_socket_finds_it_all_the_same() -> None:
    name = f"{NEW}-{'x' * 150}"
    sockets = [socket_path(FOLDER, name), *SOCKETS]
    assert os.fspath(sockets[0]) != f"{FOLDER}/{name}.sock"
    assert choose(sockets, name) == sockets[0]


def test_of_the_missions_of_a_folder_the_last_is_the_one_made_last(tmp_path: Path) -> None:
    for number, name in enumerate((NEW, OLD), start=1):  # the clock was set back in between
        (tmp_path / name).mkdir()
        (tmp_path / name / "journal.jsonl").touch()
        (tmp_path / name / "settings.yaml").write_text(f"run: {number}\n")

    assert choose(driven_in(SOCKETS, tmp_path), "last") == socket_path(FOLDER, OLD)


def test_a_folder_of_runs_leaves_those_that_are_driven_in_it(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path, "bonnbot", datetime(2026, 5, 1, 8, 30, tzinfo=UTC))
    run.journal.touch()
    assert driven_in(SOCKETS, tmp_path) == [socket_path(FOLDER, OLD)]
    assert driven_in(SOCKETS, tmp_path / "elsewhere") == []
