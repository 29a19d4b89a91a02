"""The newest run is the one made last, whatever the clock showed."""

import os
import shutil
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from fieldnav.journal.directory import RunDirectory, find_run, runs_in
from fieldnav.journal.resolved import read_settings, write_settings
from fieldnav.settings.loading import load_crop, load_robot

NOW, UNSET = datetime(2026, 5, 1, tzinfo=UTC), datetime(1970, 1, 1, tzinfo=UTC)
CROP, ROBOT = load_crop("sugar-beet"), load_robot("bonnbot")


def run_in(parent: Path, utc: datetime, name: str = "bonnbot") -> RunDirectory:
    run = RunDirectory.create(parent, name, utc)
    write_settings(run.settings, CROP, ROBOT)
    run.journal.touch()
    return run


def older_run_in(parent: Path, utc: datetime) -> RunDirectory:
    """As before runs had numbers."""
    run = RunDirectory.create(parent, "bonnbot", utc)
    run.settings.write_text("fieldnav: 0.1.0\noptions: {}\n")
    run.journal.touch()
    return run


def test_a_run_made_while_the_clock_stood_at_1970_is_the_newest(tmp_path: Path) -> None:
    runs = [run_in(tmp_path, utc) for utc in (NOW, UNSET, NOW + timedelta(days=9), UNSET, UNSET)]

    assert runs_in(tmp_path) == runs[::-1]
    assert find_run("last", tmp_path) == runs[-1]
    assert find_run("bonnbot", tmp_path) == runs[-1]
    assert read_settings(runs[-1].settings).robot == ROBOT


def test_more_than_nine_runs_of_one_second_stay_in_order(tmp_path: Path) -> None:
    runs = [run_in(tmp_path, UNSET) for _ in range(12)]

    assert runs_in(tmp_path) == runs[::-1]


def test_runs_without_a_number_count_as_older_and_go_by_their_names(tmp_path: Path) -> None:
    second, first = older_run_in(tmp_path, NOW + timedelta(days=1)), older_run_in(tmp_path, NOW)
    newest = run_in(tmp_path, UNSET)

    assert runs_in(tmp_path) == [newest, second, first]


def test_a_run_keeps_its_place_when_it_is_renamed_and_a_copy_stands_beside_it(tmp_path: Path) -> None:
    first, second, third = (run_in(tmp_path, NOW) for _ in range(3))
    renamed = RunDirectory(tmp_path / "best")
    second.path.rename(renamed.path)
    copy = RunDirectory(tmp_path / "a copy of the first")
    shutil.copytree(first.path, copy.path)

    assert runs_in(tmp_path)[:2] == [third, renamed]
    assert set(runs_in(tmp_path)[2:]) == {first, copy}
    assert find_run("last", tmp_path) == third


def test_runs_made_at_once_have_a_number_each(tmp_path: Path) -> None:
    with ThreadPoolExecutor(8) as at_once:
        runs = list(at_once.map(lambda _: run_in(tmp_path, UNSET), range(16)))

    assert sorted(run.number for run in runs) == list(range(1, 17))


@pytest.mark.parametrize(
    "content", ["", "run: x\n", "run: -1\n", "run: 99999999999\n", "#\n" * 2000 + "run: 7\n"]
)
def test_settings_that_say_no_number_are_none(content: str, tmp_path: Path) -> None:
    run = older_run_in(tmp_path, NOW)
    run.settings.write_text(content)

    assert run.number == 0
    assert run_in(tmp_path, UNSET).number == 1


def test_settings_that_are_a_pipe_are_not_waited_for(tmp_path: Path) -> None:
    run = older_run_in(tmp_path, NOW)
    run.settings.unlink()
    os.mkfifo(run.settings)

    assert runs_in(tmp_path) == [run]
