"""A mission is stopped in every way there is; the first line of `fieldnav log why` names the cause."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import pytest

from fieldnav.cli.app import run
from fieldnav.evaluation.faults_injections import injections
from fieldnav.evaluation.faults_rig import Rig, Setting
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.faults import FAULTS, FaultKind
from fieldnav.journal.directory import RunDirectory
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.injection_camera import CameraFault
from states.names import Top

STRUCK_S, WATCHED_S = 2.0, 25.0
"""The robot has reached its speed by then; every reaction comes within this."""
LANES, LENGTH_M = 2, 4.0
Strike = Callable[[Rig], object]


@dataclass
class Drive:
    """Drives in a run's directory, strikes, goes on until the mission is over, and asks why."""

    runs: Path
    printed: Callable[[], str]

    def why(self, strike: Strike, struck_s: float = STRUCK_S, then: Strike | None = None) -> list[str]:
        """The lines of `log why`; `then` is done once the mission stands."""
        directory = RunDirectory.create(self.runs, "demo", datetime(2026, 5, 1, 8, 30, tzinfo=UTC))
        field = revised(load_field("demo"), {"lanes": LANES, "length_m": LENGTH_M})
        robot = smaller(load_robot("bonnbot"), 4)
        rig = Rig(Setting(field, load_crop(field.crop), robot), directory.path)
        try:
            rig.mission.start(0.0)
            self._until(rig, struck_s, stands=False)
            strike(rig)
            self._until(rig, struck_s + WATCHED_S, stands=True)
            if then is not None:
                then(rig)
                self._until(rig, rig.now_s + 1, stands=False)
        finally:
            rig.close()
        assert run(["log", "why", "--runs", str(self.runs)]) == 0
        return self.printed().splitlines()

    @staticmethod
    def _until(rig: Rig, at_s: float, stands: bool) -> None:
        while rig.now_s < at_s and not rig.broken_off:
            if stands and (rig.mission.over or rig.killed or rig.leaf[0] is Top.PAUSED):
                return
            rig.round()


@pytest.fixture
def drive(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Iterator[Drive]:
    yield Drive(tmp_path / "runs", lambda: capsys.readouterr().out)


FRONT_LEFT = "module front_left"
CAUSES = {
    "camera unplugged": "front camera cannot be read",
    "camera frozen": "front camera: the same picture for",
    "camera black": "front camera: brightness 0 of 255, limit 10",
    "camera white": "front camera: brightness 255 of 255",
    "camera of the wrong size": "front camera gives 160x90, its file says 320x180",
    "camera upside down": "front camera: the ground moves against what the wheels say",
    "frames late": "newest frame is 0.8",
    "module late": f"{FRONT_LEFT} last reported",
    "module silent": f"{FRONT_LEFT} (node 3) has been silent for",
    "module rebooted": f"{FRONT_LEFT} (node 3) has left operation or rebooted",
    "emergency stop pressed": "module rear_right (node 1): emergency stop",
    "emergency stop pressed for 0.1 s": "module rear_right (node 1): emergency stop",
    "module failed": f"{FRONT_LEFT} (node 3): EMCY 7100",
    "module unhealthy": f"{FRONT_LEFT} (node 3): ",
    "module not in drive mode": f"{FRONT_LEFT} (node 3): in mode decoupled, not drive",
    "module not as in the robot file": "HomeCount is 1 in the module but 0 in the robot file",
    "drive runs away": f"{FRONT_LEFT} drives at",
    "steering stuck": FRONT_LEFT,
    "wheels stand still": "the wheels were told to move for 3 s and stand still",
    "bus off": "the controller has left the bus",
    "bus flooded": "a second, limit",
    "bus garbled": f"{FRONT_LEFT} (node 3) has said 5 times within a second what cannot be",
    "foreign command": "is commanded by another sender",
    "drive mode set by another": "is commanded by another sender: RPDO3_Mode Mode 2",
    "battery flat": "charge 5 percent, limit 10",
    "loop late": "two rounds of the loop 0.30 s apart, limit 0.10 s",
    "disk full": "No space left on device",
    "error in the program": "ZeroDivisionError",
}
"""What the first line must say besides the fault's name, for every fault that ends in a stop."""


@pytest.mark.parametrize("name", CAUSES)
def test_the_first_line_names_the_fault_that_struck(name: str, drive: Drive) -> None:
    injection = next(each for each in injections() if each.name == name)

    first, advice, *_ = drive.why(injection.strike)

    verb = "paused at 0:0" if injection.fault is FaultKind.FOREIGN_COMMAND else "stopped at 0:"
    assert first.startswith(verb)
    assert f": {injection.fault.value}: " in first
    assert CAUSES[name] in first
    assert advice == f"look at: {FAULTS[injection.fault].advice}"


def test_a_process_that_was_killed_has_broken_off_where_its_ledger_ends(drive: Drive) -> None:
    injection = next(each for each in injections() if each.fault is FaultKind.PROCESS_KILLED)

    first, advice, *_ = drive.why(injection.strike)

    assert first.startswith("broke off at 0:0")
    assert "in lane 1, in Forward.Follow.Tracking: process killed: the journal ends without a stop" in first
    assert advice == "look at: run --resume"


def test_rows_that_are_not_found_are_told_with_the_way_that_was_looked(drive: Drive) -> None:
    first, *_ = drive.why(_blind, struck_s=0.02)

    assert "Forward.Follow.Acquiring -> Fault.Recoverable: no rows found (crept 1.0" in first


def test_an_operators_stop_names_the_operator(drive: Drive) -> None:
    first, *_ = drive.why(lambda rig: rig.mission.end(rig.now_s, "stopped by alice"))

    assert first.endswith("Forward.Follow.Tracking -> Fault.Recoverable: stopped by alice")


def test_a_pause_names_who_paused(drive: Drive) -> None:
    first, *_ = drive.why(lambda rig: rig.operating.pause(rig.now_s, "by bob"))

    assert first.startswith("paused at 0:02.0 in lane 1")
    assert first.endswith("Forward.Follow.Tracking -> Paused: paused by bob")


def test_a_stop_while_it_stood_already_names_what_it_stood_for(drive: Drive) -> None:
    takeover = next(each for each in injections() if each.fault is FaultKind.FOREIGN_COMMAND)

    first, advice, *_ = drive.why(
        takeover.strike, then=lambda rig: rig.mission.end(rig.now_s, "interrupted by the operator")
    )

    assert "Paused -> Fault.Recoverable: interrupted by the operator; it had stood since 0:02.0" in first
    assert "foreign command: module rear_right (node 1) is commanded by another sender" in first
    assert advice == f"look at: {FAULTS[FaultKind.FOREIGN_COMMAND].advice}"


def _blind(rig: Rig) -> None:
    for camera in rig.cameras.values():
        camera.break_by(CameraFault.BARE, rig.now_s)
