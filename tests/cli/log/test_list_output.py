"""Standard output that takes no more, or not every letter."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from .made import a_run


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a device that is always full")
def test_a_full_disk_behind_standard_output_is_one_line(runs: Path) -> None:
    a_run(runs, "demo", completed=True)
    command = [sys.executable, "-m", "fieldnav", "log", "list", "--runs", str(runs)]

    with Path("/dev/full").open("w") as full:
        ended = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)

    assert ended.returncode == 2
    assert ended.stderr == "error: standard output: cannot be written: No space left on device\n"


def test_a_name_that_the_terminal_cannot_show_is_shown_in_escapes(runs: Path) -> None:
    a_run(runs, "demo", completed=True).path.rename(runs / os.fsdecode(b"\xff"))
    command = [sys.executable, "-m", "fieldnav", "log", "list", "--runs", str(runs)]

    ended = subprocess.run(command, capture_output=True, text=True, check=False)

    assert (ended.returncode, ended.stderr) == (0, "") and "\\udcff" in ended.stdout
