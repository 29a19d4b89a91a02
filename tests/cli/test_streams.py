"""Standard output that has gone: no traceback, and an exit status that tells."""

import subprocess
import sys
from pathlib import Path

import pytest

FIELDNAV = f"{sys.executable} -m fieldnav"


def shell(command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)


def test_a_closed_output_is_said_in_one_line() -> None:
    done = shell(f"{FIELDNAV} profiles list >&-")

    assert done.returncode == 2
    assert done.stderr.startswith("error: standard output: cannot be written")
    assert len(done.stderr.splitlines()) == 1


def test_a_reader_that_leaves_early_is_no_error() -> None:
    done = shell(f"{FIELDNAV} profiles show sugar-beet | head -1 >/dev/null; echo ${{PIPESTATUS[0]}}")

    assert done.stdout.strip() == "0"
    assert done.stderr == ""


def test_a_robot_that_is_not_well_is_no_success_where_nobody_reads_on(tmp_path: Path) -> None:
    called = (
        f"{FIELDNAV} run --crop sugar-beet --robot bonnbot --out {tmp_path} | true; exit ${{PIPESTATUS[0]}}"
    )

    done = shell(called)

    assert done.returncode == 1
    assert all(line.startswith("error: nothing was driven") for line in done.stderr.splitlines())


@pytest.mark.parametrize("command", ["log list", "profiles list", "profiles show sugar-beet", "--help"])
def test_a_full_output_is_said_in_one_line(command: str) -> None:
    done = shell(f"{FIELDNAV} {command} > /dev/full")

    said = "error: standard output: cannot be written: No space left on device\n"
    assert (done.returncode, done.stderr) == (2, said)


@pytest.mark.parametrize(
    "stream", ["2>/dev/full", "2>&-", "2> >(true)", ">/dev/full 2>/dev/full", ">&- 2>&-"]
)
def test_an_error_that_nobody_hears_has_its_status_all_the_same(stream: str) -> None:
    assert shell(f"{FIELDNAV} log show no-such-run {stream}").returncode == 2


def test_an_error_after_a_full_output_is_the_only_line() -> None:
    done = shell(f"{FIELDNAV} profiles validate sugar-beet nothing > /dev/full")

    assert done.returncode == 2
    assert len(done.stderr.splitlines()) <= 2 and "Exception" not in done.stderr


def test_where_no_home_can_be_written_no_library_complains(picture: Path, tmp_path: Path) -> None:
    homeless = "env HOME=/proc MPLCONFIGDIR=/proc/none"

    done = shell(f"{homeless} {FIELDNAV} detect {picture} --json --overlay {tmp_path / 'overlays'}")

    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "overlays" / "field-rows.jpg").exists()
