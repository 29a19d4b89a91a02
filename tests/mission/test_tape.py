"""What a tape hands to the recorder, and what becomes of the mission when the recording fails."""

from contextlib import nullcontext
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import can
import numpy as np
import pytest

from drivers.compression import compressed, decoded
from fieldnav.errors import DriverError, OutputError
from fieldnav.faults import FaultKind
from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import CameraName, Frame, Motion
from fieldnav.mission.gate import Passed
from fieldnav.mission.tape import Tape, taping
from fieldnav.mission.taped import TapedRound
from fieldnav.mission.taped_camera import TapedCamera
from fieldnav.mission.tick import Tick
from fieldnav.recording.recorder import Recorder
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Call
from fieldnav.settings.loading import load_robot
from states.behaviour import Step
from states.names import Top

BEGUN = datetime(2026, 5, 1, tzinfo=UTC)
ROBOT = load_robot("bonnbot")


class Giving:
    """A camera that gives, or raises, what it is told to."""

    def __init__(self) -> None:
        self.next: Frame | None = None
        self.error: DriverError | None = None

    def latest(self, now_s: float) -> Frame | None:
        if self.error is not None:
            raise self.error
        return self.next

    def close(self) -> None:
        """Nothing to give back."""


def a_frame(sequence: int) -> Frame:
    noise = np.random.default_rng(sequence).integers(0, 255, (36, 64, 3), np.uint8)
    return Frame(CameraName.FRONT, sequence, sequence / 15, noise)


def test_the_mission_sees_the_picture_that_is_recorded(tmp_path: Path) -> None:
    camera, directory = Giving(), RunDirectory(tmp_path)
    camera.next = a_frame(1)
    with taping(directory, ROBOT, BEGUN, record=True, waits=True) as tape:
        eye = TapedCamera(CameraName.FRONT, camera, tape, 90)
        with tape.round(Call.TICK, 0.1):
            seen = eye.latest(0.1)

    assert seen is not None
    with_recording = Recording.open(directory)
    assert with_recording is not None
    with with_recording as recording:
        (round_,) = recording.rounds()
        picture = recording.picture(round_.frames[0])
    assert picture is not None
    assert round_.frames[0].stamp_s == seen.stamp_s
    np.testing.assert_array_equal(decoded(picture.jpeg), seen.image)


def test_a_frame_is_taped_once_and_a_camera_that_gives_none_with_its_reason(tmp_path: Path) -> None:
    camera, directory = Giving(), RunDirectory(tmp_path)
    with taping(directory, ROBOT, BEGUN, record=True, waits=True) as tape:
        eye = TapedCamera(CameraName.FRONT, camera, tape, 90)
        for now_s in (0.1, 0.2, 0.3):
            camera.next = camera.next or a_frame(1)
            camera.error = DriverError("no cable", FaultKind.CAMERA_UNPLUGGED) if now_s == 0.2 else None
            raised = pytest.raises(DriverError) if camera.error else nullcontext()
            with tape.round(Call.TICK, now_s), raised:
                eye.latest(now_s)

    opened = Recording.open(directory)
    assert opened is not None
    with opened as recording:
        rounds = list(recording.rounds())
    assert [len(each.frames) for each in rounds] == [1, 0, 0]
    assert [[lost.said for lost in each.lost] for each in rounds] == [[], ["no cable"], []]


def test_a_frame_that_comes_compressed_is_not_compressed_again() -> None:
    once = compressed(a_frame(1), 90)

    assert compressed(once, 50) is once
    assert compressed(replace(once, jpeg=None), 50).jpeg != once.jpeg


def test_a_recording_that_fails_is_said_once_and_the_mission_goes_on(
    tmp_path: Path,
) -> None:
    tick = Tick(0.0, (Top.CHECKING,), None, Step(), Passed(Motion(), {}), 1, 3, 0, 0.0, 0.0)
    recorder = Recorder(RunDirectory(tmp_path / "nowhere"), ROBOT.recording, BEGUN, waits=True)
    tape = Tape(recorder, BEGUN)
    tape.watch(tick)
    recorder.close()

    with pytest.raises(OutputError, match="cannot be written"):
        tape.watch(tick)
    tape.watch(tick)
    assert "cannot be written" in tape.end()[0]
    assert tape.end() == ()


def test_a_round_of_a_flooded_bus_counts_what_it_holds() -> None:
    quiet, flooded = (TapedRound(Call.TICK, 0.0, 0) for _ in range(2))
    quiet.wires += [(True, can.Message())] * 8
    flooded.wires += [(False, can.Message())] * 1000

    assert flooded.size - quiet.size > 500_000
