"""A command replaces a regular file and nothing else, and writes it whole, for its owner alone."""

import os
import stat
from collections.abc import Callable
from pathlib import Path

import pytest

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory

WRITERS = {
    "log report": ["log", "report", "--out"],
    "log plot": ["log", "plot", "--out"],
    "log export --csv": ["log", "export", "--force", "--csv"],
    "log export --mcap": ["log", "export", "--force", "--mcap"],
    "diagram": ["diagram", "--out"],
    "simulate --serve": ["simulate", "--serve", "--sketch", "--robot-file"],
}
NAMES = {"log plot": "out.png", "simulate --serve": "out.yaml"}


def null_device(path: Path) -> None:
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(1, 3))
    except PermissionError:
        pytest.skip("only root makes device nodes")


OBSTACLES: dict[str, Callable[[Path], object]] = {
    "a pipe": os.mkfifo,
    "a device": null_device,
    "a folder": Path.mkdir,
    "a link to a file": lambda path: path.symlink_to(path.parent / "other"),
    "a link to nothing": lambda path: path.symlink_to(path.parent / "nothing"),
    "a link to a folder": lambda path: path.symlink_to(path.parent / "folder"),
}


@pytest.fixture
def target(tmp_path: Path) -> Path:
    folder = tmp_path / "out"
    (folder / "folder").mkdir(parents=True)
    (folder / "other").write_text("not to be touched")
    return folder


def listing(folder: Path) -> dict[str, tuple[int, int]]:
    return {path.name: (path.lstat().st_ino, path.lstat().st_mode) for path in folder.rglob("*")}


@pytest.mark.parametrize("obstacle", OBSTACLES)
@pytest.mark.parametrize("writer", WRITERS)
def test_what_is_no_regular_file_is_refused_and_left_as_it_is(
    writer: str, obstacle: str, directory: RunDirectory, target: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = target / NAMES.get(writer, "out")
    OBSTACLES[obstacle](path)
    before = listing(target)

    status = run([*WRITERS[writer], str(path)])

    said = capsys.readouterr().err
    assert (status, said.count("\n")) == (2, 1)
    kind = "a pipe or a device" if obstacle in ("a pipe", "a device") else " ".join(obstacle.split()[:2])
    assert f"{path}: " in said and f"is {kind}; allowed is " in said
    assert listing(target) == before
    assert (target / "other").read_text() == "not to be touched"


@pytest.mark.parametrize("writer", [name for name in WRITERS if name != "simulate --serve"])
def test_a_regular_file_is_replaced_by_a_private_one(
    writer: str, directory: RunDirectory, target: Path
) -> None:
    path = target / NAMES.get(writer, "out")
    path.write_text("old")
    path.chmod(0o644)

    assert run([*WRITERS[writer], str(path)]) == 0

    assert path.read_bytes() != b"old"
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert {each.name for each in target.iterdir()} == {path.name, "folder", "other"}


@pytest.mark.parametrize("writer", WRITERS)
def test_a_folder_that_is_not_there_is_refused(
    writer: str, directory: RunDirectory, target: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = target / "none" / NAMES.get(writer, "out")

    assert run([*WRITERS[writer], str(path)]) == 2

    assert f"{path}: cannot be written: No such file or directory" in capsys.readouterr().err
    assert not path.parent.exists()


@pytest.mark.parametrize(
    "arguments",
    [
        *WRITERS.values(),
        ["simulate", "--out"],
        ["run", "--robot", "bonnbot", "--crop", "sugar-beet", "--out"],
        ["check", "--robot", "bonnbot", "--out"],
        ["replay", "x.mcap", "--out"],
        ["detect", "x.png", "--overlay"],
        ["bench", "navigation", "--plot"],
        ["bench", "detection", "--plot"],
        ["bench", "fuzz", "--keep"],
    ],
)
def test_an_empty_name_is_refused(
    arguments: list[str], directory: RunDirectory, capsys: pytest.CaptureFixture[str]
) -> None:
    before = sorted(Path().rglob("*"))

    assert run([*arguments, ""]) == 2

    said = capsys.readouterr().err
    assert (
        f"{arguments[-1]}" in said and "'' is not allowed; allowed is the name of a file or a folder" in said
    )
    assert said.count("\n") == 1
    assert sorted(Path().rglob("*")) == before


@pytest.mark.parametrize("obstacle", OBSTACLES)
@pytest.mark.parametrize("arguments", [["simulate", "--sketch", "--out"], ["log", "report"]])
def test_neither_a_run_nor_its_report_goes_into_what_is_no_folder_and_no_file(
    arguments: list[str],
    obstacle: str,
    directory: RunDirectory,
    target: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    into_folder = arguments[0] == "simulate"
    if into_folder and obstacle in ("a folder", "a link to a folder"):
        pytest.skip("a run's directory may be made there")
    path = target / "out" if into_folder else directory.report
    OBSTACLES[obstacle](path)
    before = listing(target)

    status = run([*arguments, *([str(path)] if into_folder else [])])

    said = capsys.readouterr().err
    assert (status, said.count("\n")) == (2, 1) and path.name in said
    assert listing(target) == before
