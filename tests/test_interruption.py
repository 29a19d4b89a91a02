"""A run that is told to stop: the wheels stand still, the journal says who stopped it, nothing is lost."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import can
import pytest

from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.journal.journal import read

LONGEST_S = 60.0
"""To start up and to draw a few frames on a busy machine; a bound, not an expectation."""
MODULES = 4


def last_drive_commands(path: Path) -> list[float]:
    """The last speed that each module was told, per mille."""
    layout, told = wire_layout(), {}
    for frame in can.CanutilsLogReader(path):
        telegram = layout.read(frame)
        if telegram is not None and telegram.kind is Kind.DRIVE:
            told[telegram.node] = telegram.values["DriveSpeed"]
    return list(told.values())


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM])
def test_a_run_that_is_told_to_stop_leaves_its_wheels_at_zero(stop: signal.Signals, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "fieldnav", "simulate", "demo", "--out", str(tmp_path)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL) as run:
        until = time.monotonic() + LONGEST_S
        while not any(b"Tracking" in path.read_bytes() for path in tmp_path.glob("*/journal.jsonl")):
            assert time.monotonic() < until, "the run begins to follow"
            assert run.poll() is None, "the run goes on until it is told to stop"
        run.send_signal(stop)
        _, said = run.communicate(timeout=LONGEST_S)
    assert run.returncode == 130
    assert b"Traceback" not in said
    (folder,) = tmp_path.iterdir()
    assert read(folder / "journal.jsonl")[-1].reason == "interrupted by the operator"
    assert last_drive_commands(folder / "can.log") == [0] * MODULES
    assert (folder / "summary.json").exists()
