"""Each round gets the pictures that it took in, and no others."""

from datetime import UTC, datetime
from pathlib import Path

import cv2
import numpy as np

from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import CameraName
from fieldnav.mission.taped import TapedFrame, TapedRound
from fieldnav.recording.message import Recordable
from fieldnav.recording.recorder import Recorder
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Call, Seen
from fieldnav.replay.rounds import Taken, taken
from fieldnav.settings.recording import RecordingSettings

BEGUN = datetime(2026, 5, 1, 8, 30, 0, 123456, tzinfo=UTC)
STAMP_S = 1.0 / 3


def seen(sequence: int, stamp_s: float, camera: CameraName = CameraName.FRONT) -> Seen:
    return Seen(camera=camera, sequence=sequence, stamp_s=stamp_s)


def picture(which: Seen, grey: int) -> TapedFrame:
    jpeg = cv2.imencode(".jpg", np.full((16, 16, 3), grey, np.uint8))[1].tobytes()
    return TapedFrame(which, jpeg, BEGUN)


def tick(now_s: float, *frames: Seen) -> TapedRound:
    return TapedRound(Call.TICK, now_s, 0, frames=list(frames))


def as_taken(folder: Path, *items: Recordable) -> list[Taken]:
    directory = RunDirectory(folder)
    with Recorder(directory, RecordingSettings(keep_free_gb=0), BEGUN, waits=True) as recorder:
        for item in items:
            recorder.put(item)
    assert recorder.failure is None
    with Recording.open(directory) as recording:
        return list(taken(recording))


def test_a_picture_of_a_killed_process_is_not_taken_for_one_of_the_next(tmp_path: Path) -> None:
    left, new = seen(7, STAMP_S), seen(7, STAMP_S + 2)

    (only,) = as_taken(tmp_path, picture(left, 10), picture(new, 200), tick(STAMP_S + 2.01, new))

    assert only.lacking == ()
    assert (only.frames[0].stamp_s, only.frames[0].image.mean()) == (new.stamp_s, 200)


def test_a_camera_whose_clock_is_ahead_hides_no_picture_of_the_other(tmp_path: Path) -> None:
    ahead, behind = seen(1, 0.9), seen(1, 0.4, CameraName.REAR)

    (only,) = as_taken(tmp_path, picture(ahead, 10), picture(behind, 20), tick(0.5, ahead, behind))

    assert only.lacking == ()
    assert [frame.camera for frame in only.frames] == [CameraName.FRONT, CameraName.REAR]


def test_a_picture_that_is_not_there_is_told(tmp_path: Path) -> None:
    there, gone = seen(1, STAMP_S), seen(2, STAMP_S + 0.1)

    first, second = as_taken(tmp_path, picture(there, 10), tick(0.4, there), tick(0.5, gone))

    assert (len(first.frames), first.lacking) == (1, ())
    assert (second.frames, second.lacking) == ((), (gone,))
