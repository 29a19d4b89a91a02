"""Disk, clock and load of the computer."""

from dataclasses import replace
from datetime import UTC, datetime

import pytest

from fieldnav.preflight.computer import read_computer
from fieldnav.preflight.computer_checks import computer_findings
from fieldnav.preflight.finding import Verdict


def check(computer):
    return {finding.check: finding for finding in computer_findings(computer)}


def test_a_computer_that_is_well_is_told_so_with_its_figures(computer):
    found = check(computer)

    assert {finding.verdict for finding in found.values()} == {Verdict.OK}
    assert found["disk"].figure == "50000 MB free for runs"
    assert found["clock"].figure == "2026-06-01 09:30 UTC"
    assert found["computer"].figure == "0.5 of 2 processors busy"


@pytest.mark.parametrize(
    ("free_bytes", "verdict"),
    [
        (2_000_000_000, Verdict.OK),
        (1_999_999_999, Verdict.WARNING),
        (200_000_000, Verdict.WARNING),
        (199_999_999, Verdict.FAIL),
    ],
)
def test_a_disk_that_fills_up_is_warned_of_and_a_full_one_fails(computer, free_bytes, verdict):
    assert check(replace(computer, free_bytes=free_bytes))["disk"].verdict is verdict


def test_a_clock_that_is_wrong_or_alone_is_warned_of(computer):
    long_ago = check(replace(computer, utc=datetime(1970, 1, 1, tzinfo=UTC)))["clock"]
    before = check(replace(computer, utc=datetime(2026, 4, 30, tzinfo=UTC)))["clock"]
    alone = check(replace(computer, synchronised=False))["clock"]
    unknown = check(replace(computer, synchronised=None))["clock"]

    assert [one.verdict for one in (long_ago, before, alone)] == [Verdict.WARNING] * 3
    assert before.figure == "2026-04-30 00:00 UTC is before 2026-05-01 00:00"
    assert "not synchronised" in alone.figure
    assert unknown.verdict is Verdict.OK


def test_a_clock_too_coarse_for_the_loop_fails(computer):
    found = check(replace(computer, tick_s=0.016))["clock"]

    assert found.verdict is Verdict.FAIL
    assert "16 ms" in found.figure


def test_a_computer_with_more_to_do_than_processors_is_warned_of(computer):
    assert check(replace(computer, load=2.0))["computer"].verdict is Verdict.OK
    assert check(replace(computer, load=2.1))["computer"].verdict is Verdict.WARNING


def test_the_folder_of_runs_is_tried_but_not_made(tmp_path):
    runs = tmp_path / "new" / "runs"

    read = read_computer(runs)

    assert (read.refusal, list(tmp_path.iterdir())) == ("", [])
    assert read.free_bytes > 0
    assert read.processors >= 1


def test_a_folder_of_runs_that_cannot_be_written_fails_with_the_reason(tmp_path):
    (tmp_path / "runs").write_text("a file")

    found = check(read_computer(tmp_path / "runs"))["disk"]

    assert found.verdict is Verdict.FAIL
    assert "cannot be written: Not a directory" in found.figure
    assert "--out" in found.advice


def test_whether_the_clock_is_synchronised_is_asked_of_systemd(tmp_path):
    nobody = read_computer(tmp_path, time_sync=tmp_path / "none").synchronised
    not_yet = read_computer(tmp_path, time_sync=tmp_path).synchronised
    (tmp_path / "synchronized").touch()
    by_now = read_computer(tmp_path, time_sync=tmp_path).synchronised

    assert (nobody, not_yet, by_now) == (None, False, True)
