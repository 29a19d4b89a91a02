"""Faults strike a mission in its states, and it does what the table of faults declares."""

import os
import signal
from dataclasses import dataclass

import pytest

from fieldnav.cli.app import run as command
from fieldnav.errors import SettingsError
from fieldnav.evaluation.faults import FaultsPlan, Played, pairs
from fieldnav.evaluation.faults_copy import CopyError, in_a_copy
from fieldnav.evaluation.faults_drive import Unplayed, Wanted, play
from fieldnav.evaluation.faults_expected import TOLD_AT_REST, Expected, expected
from fieldnav.evaluation.faults_figures import coverage
from fieldnav.evaluation.faults_injection import Injection
from fieldnav.evaluation.faults_injections import injections
from fieldnav.evaluation.faults_pair import PairResult
from fieldnav.faults import FAULTS, FaultKind, Reaction
from states.names import text
from states.table import CHECKING, FINISHED, IDLE, LANE_LEAVES, LATCHED, LEAVES, PAUSED, RECOVERABLE, RESUMING

INJECTIONS = injections()
WITHIN_S = 0.3
FOLLOWING = "Forward.Follow.Tracking"
LATER = frozenset({FaultKind.STEERING_STUCK, FaultKind.DISK_FULL})
"""Faults that show only when the wheels must turn, or something must be written down."""
PLAYED = (
    *(Wanted(each.name, FOLLOWING) for each in INJECTIONS if each.fault not in LATER),
    *(
        Wanted(each.value, leaf)
        for leaf in ("Paused", "Fault.Recoverable")
        for each in (FaultKind.CAMERA_SIZE, FaultKind.CAMERA_BLACK, FaultKind.MODULE_REBOOTED)
    ),
    Wanted(FaultKind.CAMERA_SIZE.value, "Idle"),
    Wanted(FaultKind.MODULE_REBOOTED.value, "Idle"),
    Wanted(FaultKind.DRIVE_RUNAWAY.value, "Fault.Latched"),
    Wanted(FaultKind.CAMERA_BLACK.value, "Forward.Follow.Coasting"),
    Wanted(FaultKind.MODULE_SILENT.value, "Resuming"),
    *(
        Wanted(f"{FaultKind.EMERGENCY_STOP.value} for 0.1 s", leaf)
        for leaf in ("Idle", "Checking", "Paused", "Fault.Recoverable", "Fault.Latched")
    ),
    Wanted(FaultKind.EMERGENCY_STOP.value, "Fault.Recoverable"),
    Wanted(FaultKind.MODULE_MODE.value, "Paused"),
)
"""Pairs that come by within the first quarter of a minute of a mission."""
NOT_TIMED = frozenset(
    {FaultKind.BUS_OFF, FaultKind.PROCESS_KILLED, FaultKind.BATTERY_FLAT, FaultKind.DISK_FULL}
)
"""Without a bus or a process no zero can be sent; the other two come to rest smoothly."""


@pytest.fixture(scope="module")
def played() -> dict[Wanted, PairResult]:
    """One drive, a copy of it for each pair."""
    results = play(PLAYED)
    assert not [each for each in results if isinstance(each, Unplayed)]
    return {Wanted(each.injection, each.leaf): each for each in results if isinstance(each, PairResult)}


@pytest.mark.parametrize("wanted", PLAYED, ids=lambda wanted: f"{wanted.injection}@{wanted.leaf}")
def test_a_fault_ends_in_the_reaction_that_is_declared_for_it(
    wanted: Wanted, played: dict[Wanted, PairResult]
) -> None:
    result = played[wanted]
    assert not result.problem, f'again: fieldnav bench faults --only "{result.name}"'
    assert result.stale_commands == result.run_over == 0


def test_a_zero_command_follows_every_noticed_fault_within_the_goal(
    played: dict[Wanted, PairResult],
) -> None:
    stopping = (Expected.STOPS, Expected.LATCHES, Expected.PAUSES, Expected.HELD)
    timed = [each for each in played.values() if each.expected in stopping and each.fault not in NOT_TIMED]
    late = {each.name: each.zero_s for each in timed if not each.zero_s <= WITHIN_S}
    assert len(timed) > 20
    assert not late


def test_the_coverage_has_a_line_for_every_fault_that_was_played(played: dict[Wanted, PairResult]) -> None:
    lines = coverage(list(played.values()))
    assert [each.fault for each in lines] == [each for each in FAULTS if each not in LATER]
    black = next(each for each in lines if each.fault is FaultKind.CAMERA_BLACK)
    assert black.pairs == black.as_declared == 5
    assert black.example.startswith("camera black: front camera: brightness 0 of 255")


def test_every_fault_has_an_injector_and_what_is_held_for_can_pass() -> None:
    assert {each.fault for each in INJECTIONS} == set(FaultKind)
    held = {fault for fault, declared in FAULTS.items() if declared.reaction is Reaction.HOLD}
    assert {each.fault for each in INJECTIONS if each.passing} == held
    assert all(each.passes for each in INJECTIONS if each.passing)
    assert len({each.name for each in INJECTIONS}) == len(INJECTIONS)


@pytest.mark.parametrize("injection", INJECTIONS, ids=lambda injection: injection.name)
def test_where_the_robot_drives_the_declared_reaction_is_expected(injection: Injection) -> None:
    wanted = {
        Reaction.CONTINUE: Expected.GOES_ON,
        Reaction.SLOW: Expected.SLOWER,
        Reaction.HOLD: Expected.HELD if injection.passing else Expected.STOPS,
        Reaction.PAUSE: Expected.PAUSES,
        Reaction.STOP: Expected.STOPS,
        Reaction.LATCH: Expected.LATCHES,
        Reaction.MODULES_STOP: Expected.MODULES_STOP,
    }
    assert {expected(leaf, injection) for leaf in LANE_LEAVES} == {wanted[injection.reaction]}


def test_nothing_is_expected_of_a_fault_that_is_over_before_anything_moves() -> None:
    late = next(each for each in INJECTIONS if each.fault is FaultKind.LOOP_LATE)
    assert {expected(leaf, late) for leaf in (IDLE, CHECKING, RESUMING)} == {Expected.UNTOUCHED}
    assert {expected(leaf, late) for leaf in (PAUSED, RECOVERABLE)} == {Expected.STANDS}


def test_a_state_that_is_the_end_is_expected_to_stay_whatever_breaks() -> None:
    struck = [each for each in INJECTIONS if each.reaction is not Reaction.MODULES_STOP]
    assert {expected(leaf, each) for leaf in (LATCHED, FINISHED) for each in struck} == {Expected.STANDS}


def test_what_a_person_would_drive_on_with_is_expected_to_show_itself_then() -> None:
    stuck = next(each for each in INJECTIONS if each.fault is FaultKind.STEERING_STUCK)
    passing = next(each for each in INJECTIONS if each.passing)
    for leaf in (PAUSED, RECOVERABLE):
        assert expected(leaf, stuck) is Expected.LATCHES
        assert expected(leaf, passing) is Expected.STANDS


def test_what_the_modules_tell_at_rest_makes_a_stop_of_a_pause_and_is_written_down_elsewhere() -> None:
    told = [each for each in INJECTIONS if each.fault in TOLD_AT_REST]
    assert len(told) > 4
    assert {expected(PAUSED, each) for each in told} == {Expected.STOPS}
    assert {expected(leaf, each) for leaf in (RECOVERABLE, LATCHED) for each in told} == {Expected.STANDS}


def test_in_short_every_fault_and_every_state_comes_by() -> None:
    wanted = pairs(FaultsPlan(quick=True))
    assert {each.leaf for each in wanted} == {text(leaf) for leaf in LEAVES}
    assert {each.injection for each in wanted} == {each.name for each in INJECTIONS}


def test_all_pairs_are_every_fault_in_every_state() -> None:
    wanted = pairs(FaultsPlan())
    assert len(set(wanted)) == len(wanted) == len(INJECTIONS) * len(LEAVES)


@pytest.mark.parametrize(
    ("only", "count"),
    [("camera black@Forward.Exit", 1), ("camera black", len(LEAVES)), ("@Paused", len(INJECTIONS))],
)
def test_one_pair_or_some_can_be_named(only: str, count: int) -> None:
    assert len(pairs(FaultsPlan(only=only))) == count


@pytest.mark.parametrize("only", ["camera blue@Paused", "camera black@Exit", "camera black@", "@", "x@y"])
def test_a_pair_that_there_is_not_is_refused_with_what_is_allowed(only: str) -> None:
    with pytest.raises(SettingsError, match=r"^--only .*allowed is one of (camera frozen|Idle)"):
        pairs(FaultsPlan(only=only))


@dataclass
class Counter:
    count: int = 0

    def up(self) -> int:
        self.count += 1
        return self.count


def test_what_a_copy_does_is_told_and_leaves_the_original_as_it_was() -> None:
    counter = Counter()
    assert in_a_copy(counter.up) == 1
    assert in_a_copy(counter.up) == 1
    assert counter.count == 0


def test_a_copy_that_breaks_off_says_why() -> None:
    with pytest.raises(CopyError, match=r"ZeroDivisionError: .* at test_faults.py:\d+"):
        in_a_copy(lambda: 1 / 0)


def test_a_copy_that_dies_is_no_result() -> None:
    with pytest.raises(CopyError, match="the process died"):
        in_a_copy(lambda: os.kill(os.getpid(), signal.SIGKILL))


def test_pairs_that_failed_are_told_apart(played: dict[Wanted, PairResult]) -> None:
    assert Played(tuple(played.values()), ()).failed == ()


def test_the_command_refuses_a_pair_that_there_is_not_in_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert command(["bench", "faults", "--only", "camera blue@Paused"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(
        "error: --only camera blue@Paused: no fault 'camera blue'; allowed is one of"
    )
    assert captured.err.count("\n") == 1
