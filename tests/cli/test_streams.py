"""Standard output that has gone: no traceback, and an exit status that tells."""

import subprocess
import sys

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
