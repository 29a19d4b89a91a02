"""Whatever stopped a mission stops its replay, in the same round and for the same reason."""

from datetime import UTC, datetime
from pathlib import Path

import pytest

from fieldnav.evaluation.faults_injections import injections
from fieldnav.evaluation.faults_rig import BEGUN, Rig, Setting
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import read
from fieldnav.journal.ledger import last_booking
from fieldnav.journal.resolved import read_settings, write_settings
from fieldnav.mission.tape import taping
from fieldnav.replay.difference import Replayed
from fieldnav.replay.replay import replay
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from states.names import Top

STRUCK_S, WATCHED_S, RESTS_S = 2.0, 25.0, 0.5
STOPS = (
    "camera unplugged",
    "camera frozen",
    "module silent",
    "module rebooted",
    "steering stuck",
    "drive runs away",
    "bus off",
    "bus garbled",
    "foreign command",
    "battery flat",
    "loop late",
    "process suspended in a round",
)


class Drive:
    """A mission in a run's directory, recorded; `again` ends it and replays it."""

    def __init__(self, runs: Path) -> None:
        self.directory = RunDirectory.create(runs, "demo", datetime(2026, 5, 1, 8, 30, tzinfo=UTC))
        self.begin()
        self.rig.operating.start(0.0)
        self.until(STRUCK_S)

    def begin(self) -> None:
        """A process drives in the run's directory, from the beginning of the field."""
        field = revised(load_field("demo"), {"lanes": 2, "length_m": 4})
        crop, robot = load_crop(field.crop), smaller(load_robot("bonnbot"), 4)
        write_settings(self.directory.settings, crop, robot, field, {"lanes": field.lanes, "side": "right"})
        self._taping = taping(self.directory, robot, BEGUN, record=True, waits=True)
        self.rig = Rig(Setting(field, crop, robot), self.directory.path, self._taping.__enter__())

    def until(self, at_s: float, stands: bool = False) -> None:
        """Go on, with `stands` until the mission is over or paused at the latest."""
        while self.rig.now_s < at_s and not self.rig.broken_off:
            if stands and (self.rig.mission.over or self.rig.leaf[0] is Top.PAUSED):
                return
            self.rig.round()

    def end(self) -> None:
        """The process ends, in whatever state the mission is."""
        self.rig.close()
        self._taping.__exit__(None, None, None)

    def again(self) -> Replayed:
        self.end()
        return replay(self.directory, read_settings(self.directory.settings))


@pytest.mark.parametrize("name", STOPS)
def test_a_stop_is_repeated_bit_for_bit(name: str, tmp_path: Path) -> None:
    drive = Drive(tmp_path)
    injection = next(each for each in injections() if each.name == name)
    injection.strike(drive.rig)
    drive.until(STRUCK_S + WATCHED_S, stands=True)
    drive.until(drive.rig.now_s + RESTS_S)

    done = drive.again()

    assert read(drive.directory.journal)[-1].reason.startswith(injection.fault.value)
    assert done.same, done


def test_what_a_person_did_is_done_again(tmp_path: Path) -> None:
    drive = Drive(tmp_path)
    operating = drive.rig.operating
    assert not operating.pause(drive.rig.now_s, "by bob")
    drive.until(STRUCK_S + 1)
    assert not operating.resume(drive.rig.now_s, "by bob")
    drive.until(STRUCK_S + 2)
    operating.pause(drive.rig.now_s, "by alice")
    assert not operating.reset(drive.rig.now_s, "by alice")
    drive.until(STRUCK_S + 4)
    operating.end(drive.rig.now_s, "stopped by alice")
    drive.until(drive.rig.now_s + RESTS_S)

    done = drive.again()

    events = [line.event for line in read(drive.directory.journal)]
    assert events.count("pause") == 2
    assert {"resume", "reset", "fail"} <= {*events}
    assert done.same, done


def test_a_run_that_was_taken_up_by_another_process_is_repeated_whole(tmp_path: Path) -> None:
    drive = Drive(tmp_path)
    drive.until(STRUCK_S + 1)
    left_s = drive.rig.now_s
    drive.end()
    booking = last_booking(drive.directory.ledger)
    assert booking is not None

    drive.begin()
    drive.rig.operating.take_up(booking)
    drive.rig.skip_to(left_s + 5)
    drive.rig.operating.start(drive.rig.now_s)
    drive.until(left_s + 9)

    done = drive.again()

    events = [line.event for line in read(drive.directory.journal)]
    assert events.count("start") == 2
    assert "place fits" in events
    assert done.same, done
