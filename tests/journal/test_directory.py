"""One folder a run; a folder that cannot be made leaves nothing behind."""

from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path

import pytest

from fieldnav.errors import FieldnavError, OutputError
from fieldnav.journal.directory import RunDirectory, find_run, runs_in

START = datetime(2026, 5, 1, 8, 30, 15, tzinfo=UTC)


def run_in(parent: Path, name: str, utc: datetime = START) -> RunDirectory:
    run = RunDirectory.create(parent, name, utc)
    run.journal.touch()
    return run


def test_a_run_is_named_by_its_time_and_its_field(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "runs", "demo", START)

    assert run.path == tmp_path / "runs" / "20260501T083015Z-demo"
    assert list(run.path.iterdir()) == []


def test_the_time_is_utc_whatever_zone_it_was_told_in(tmp_path: Path) -> None:
    here = START.astimezone(timezone(timedelta(hours=2)))

    assert RunDirectory.create(tmp_path, "demo", here).path.name == "20260501T083015Z-demo"


def test_two_runs_in_the_same_second_do_not_share_a_folder(tmp_path: Path) -> None:
    names = [RunDirectory.create(tmp_path, "demo", START).path.name for _ in range(3)]

    assert names == ["20260501T083015Z-demo", "20260501T083015Z-demo-2", "20260501T083015Z-demo-3"]


def test_a_file_in_the_way_is_one_line_and_nothing_is_left(tmp_path: Path) -> None:
    (tmp_path / "runs").write_text("in the way")

    with pytest.raises(OutputError, match="runs/deep: no run directory can be made here: ") as caught:
        RunDirectory.create(tmp_path / "runs" / "deep", "demo", START)

    assert "\n" not in str(caught.value)
    assert [path.name for path in tmp_path.iterdir()] == ["runs"]


def test_folders_made_on_the_way_are_removed_when_the_run_cannot_be_made(tmp_path: Path) -> None:
    too_long = "x" * 300

    with pytest.raises(OutputError):
        RunDirectory.create(tmp_path / "a" / "b", too_long, START)

    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("folder", ["x" * 300, "a/" + "y" * 300 + "/b"])
def test_a_folder_whose_name_is_too_long_is_one_line_and_nothing_is_left(tmp_path: Path, folder: str) -> None:
    with pytest.raises(OutputError, match="File name too long; allowed is a folder you can write"):
        RunDirectory.create(tmp_path / folder, "demo", START)

    assert list(tmp_path.iterdir()) == []


def test_the_kernels_own_folder_cannot_be_written() -> None:
    with pytest.raises(OutputError, match="allowed is a folder you can write"):
        RunDirectory.create(Path("/proc/fieldnav"), "demo", START)


def test_runs_are_listed_newest_first_and_other_folders_are_not(tmp_path: Path) -> None:
    old, new = run_in(tmp_path, "demo"), run_in(tmp_path, "beans", START + timedelta(days=1))
    (tmp_path / "notes").mkdir()

    assert runs_in(tmp_path) == [new, old]
    assert runs_in(tmp_path / "nowhere") == []


def test_a_run_is_found_by_last_by_name_by_part_and_by_path(tmp_path: Path) -> None:
    old, new = run_in(tmp_path, "demo"), run_in(tmp_path, "beans", START + timedelta(days=1))

    assert find_run("last", tmp_path) == new
    assert find_run(old.path.name, tmp_path) == old
    assert find_run("demo", tmp_path) == old
    assert find_run(str(old.path), tmp_path / "nowhere") == old


def test_a_run_that_is_none_is_an_error(tmp_path: Path) -> None:
    run_in(tmp_path, "demo")

    with pytest.raises(FieldnavError, match="no run 'maize' in"):
        find_run("maize", tmp_path)
    with pytest.raises(FieldnavError, match="holds no runs"):
        find_run("last", tmp_path / "nowhere")


def test_a_name_too_long_for_a_run_is_an_error(tmp_path: Path) -> None:
    run = run_in(tmp_path, "demo")

    with pytest.raises(FieldnavError, match=r"no run 'x+' in"):
        find_run("x" * 300, tmp_path)
    with pytest.raises(FieldnavError, match="File name too long; allowed is a folder that holds runs"):
        runs_in(tmp_path / ("x" * 300))
    assert find_run(str(run.path), tmp_path / ("x" * 300)) == run


def test_a_file_in_place_of_the_folder_of_runs_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()

    with pytest.raises(FieldnavError, match="file: cannot be read: Not a directory; allowed is a folder"):
        runs_in(tmp_path / "file")


def test_a_part_of_several_names_stands_for_the_newest(tmp_path: Path) -> None:
    run_in(tmp_path, "demo")
    newest = run_in(tmp_path, "demo", START + timedelta(days=1))

    assert find_run("demo", tmp_path) == newest


def test_of_runs_with_numbers_the_plain_name_is_the_first(tmp_path: Path) -> None:
    first = run_in(tmp_path, "demo")
    run_in(tmp_path, "demo")

    assert find_run(first.path.name, tmp_path) == first
