"""Files whose names hold escape sequences, line breaks, brackets, or bytes of no encoding."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

NAMES = [
    b"\x1b]0;owned\x07\x1b[31m",
    b"line\nerror: another",
    b"[red]x[nothing]",
    b"\xff\xfe",
    b"\xc2\x9b31m",
    "\u202e".encode(),
]
ASCII = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}


def called(*arguments: bytes, folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    command = [os.fsencode(sys.executable), b"-m", b"fieldnav", *arguments]
    return subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=folder, env=os.environ | environment
    )


@pytest.fixture
def named(picture: Path, tmp_path: Path) -> Path:
    """A folder of pictures with such names, of a robot file's and of one that is none."""
    folder = tmp_path / "named"
    folder.mkdir()
    for name in NAMES:
        shutil.copy(picture, os.fsencode(folder) + b"/" + name + b".png")
        Path(os.fsdecode(os.fsencode(folder) + b"/" + name + b".yaml")).write_text("name: x\nkind: [\n")
    return folder


@pytest.mark.parametrize("environment", [{}, ASCII], ids=["utf-8", "ascii"])
def test_detect_names_its_pictures_on_one_line_each(named: Path, environment: dict[str, str]) -> None:
    pictures = [name + b".png" for name in NAMES]

    people = called(b"detect", *pictures, folder=named, **environment)
    programs = called(b"detect", *pictures, b"--json", folder=named, **environment)

    assert (people.returncode, people.stderr) == (0, "")
    assert people.stdout.replace("\n", "").isprintable()
    assert sum(": 3 rows, " in line for line in people.stdout.splitlines()) == len(NAMES)
    read = [json.loads(line)["image"] for line in programs.stdout.splitlines()]
    assert [os.fsencode(name) for name in read] == pictures
    assert programs.stdout.replace("\n", "").isprintable() and programs.stdout.isascii()


@pytest.mark.parametrize("environment", [{}, ASCII], ids=["utf-8", "ascii"])
def test_wrong_files_are_named_on_one_line_each(named: Path, environment: dict[str, str]) -> None:
    done = called(
        b"profiles", b"validate", *(b"./" + name + b".yaml" for name in NAMES), folder=named, **environment
    )

    lines = done.stderr.splitlines()
    assert (done.returncode, done.stdout, len(lines)) == (2, "", len(NAMES)), done.stderr
    assert all(line.startswith("error: ") and line.isprintable() for line in lines)


def test_count_names_its_folder_on_one_line(named: Path) -> None:
    folder = os.fsencode(named.parent) + b"/" + NAMES[0] + NAMES[1]
    shutil.copytree(os.fsencode(named), folder)

    done = called(b"count", folder, folder=named)

    assert done.returncode == 0, done.stderr
    assert (done.stdout + done.stderr).replace("\n", "").isprintable()
    assert not any(line.startswith("error") for line in (done.stdout + done.stderr).splitlines())


def test_a_video_whose_name_is_no_text_is_refused_before_opencv_breaks_down(tmp_path: Path) -> None:
    Path(os.fsdecode(os.fsencode(tmp_path) + b"/\xff.avi")).write_bytes(b"RIFF")

    done = called(b"count", b"\xff.avi", folder=tmp_path)

    assert done.returncode == 2
    assert (
        done.stderr.startswith("error: \\udcff.avi: the name is no text")
        and len(done.stderr.splitlines()) == 1
    )
