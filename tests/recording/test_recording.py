"""What was recorded is read back, by the run's own time, without reading the rest."""

from collections.abc import Callable
from datetime import UTC, datetime
from io import BufferedReader, FileIO
from pathlib import Path
from typing import Any, BinaryIO

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import CameraName
from fieldnav.recording.foxglove import compressed_image
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.opening import BLOCK_BYTES
from fieldnav.recording.picture import Picture
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Call, Gap, Round, Seen, Stepped, Wire
from fieldnav.recording.stamps import Stamps

DAY_S = 86400.0


class Counted:
    """Counts what is read of files, block by block as it comes from the system."""

    def __init__(self) -> None:
        self.bytes = 0

    def __call__(self, path: Path) -> BinaryIO:
        return BufferedReader(CountedFile(path, self), BLOCK_BYTES)


class CountedFile(FileIO):
    def __init__(self, path: Path, counted: Counted) -> None:
        super().__init__(path, "rb")
        self.counted = counted

    def readinto(self, buffer: Any, /) -> int:
        count = super().readinto(buffer)
        self.counted.bytes += count
        return count


@given(st.floats(-1, DAY_S), st.datetimes(datetime(2020, 1, 1), datetime(2060, 1, 1)))
def test_stamps_come_back_to_a_nanosecond(stamp_s: float, begun: datetime) -> None:
    stamps = Stamps.since(begun.replace(tzinfo=UTC))

    assert stamps.to_s(stamps.to_ns(stamp_s)) == pytest.approx(stamp_s, abs=6e-10)


def test_a_run_that_was_not_recorded_has_no_recording(directory: RunDirectory) -> None:
    assert Recording.open(directory) is None


def test_records_come_back_as_they_were(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    seen = Seen(camera=CameraName.REAR, sequence=7, stamp_s=0.1 + 0.2)
    call = Round(call=Call.TICK, now_s=0.1 + 0.2, frames=(seen,), wires=(Wire(sent=True, id=0x201),))
    step = Stepped(now_s=0.3, state="Forward.Exit", lane=2, forward_m=12.5, frame=seen)
    gap = Gap(from_s=1.0, to_s=2.0, frames=3)
    contents = {Topic.ROUND: call, Topic.STEP: step, Topic.GAP: gap, Topic.TICK: made_up.ticked(0.3)}

    record(
        made_up.item([Message(topic, 0.3, one.model_dump_json().encode())]) for topic, one in contents.items()
    )

    with Recording.open(directory) as recording:
        assert list(recording.rounds()) == [call]
        assert list(recording.steps()) == [step]
        assert list(recording.gaps()) == [gap]
        assert list(recording.ticks()) == [made_up.ticked(0.3)]


@pytest.mark.parametrize(
    ("begin_s", "end_s", "first", "last"),
    [(0.5, 1.0, 0.5, 1.0), (0.501, 0.999, 0.52, 0.98), (-5.0, 0.0, 0.0, 0.0), (1.9, 99.0, 1.9, 1.98)],
)
def test_a_stretch_of_time_has_both_its_ends(
    begin_s: float,
    end_s: float,
    first: float,
    last: float,
    directory: RunDirectory,
    record: Callable[..., None],
    made_up: Any,
) -> None:
    record(made_up.items(100))

    with Recording.open(directory) as recording:
        stamps = [tick.now_s for tick in recording.ticks(begin_s, end_s)]
    assert (stamps[0], stamps[-1]) == pytest.approx((first, last))
    assert len(stamps) == round((last - first) / 0.02) + 1


def test_a_picture_is_found_by_its_frame_and_decoded(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    drawn = np.full((36, 64, 3), (40, 160, 60), np.uint8)
    jpeg = cv2.imencode(".jpg", drawn)[1].tobytes()
    stamp_s = 1 / 3
    data = compressed_image(CameraName.FRONT, made_up.begun, jpeg)
    record([*made_up.items(20), made_up.item([Message(Topic.FRONT_IMAGE, stamp_s, data, 2**32 + 5)], True)])

    with Recording.open(directory) as recording:
        exact = Seen(camera=CameraName.FRONT, sequence=2**32 + 5, stamp_s=stamp_s)
        rounded = exact.model_copy(update={"stamp_s": round(stamp_s, 6)})
        assert recording.picture(exact) == Picture(exact, jpeg)
        assert recording.picture(rounded) == Picture(rounded, jpeg)
        assert np.abs(recording.picture(exact).image().astype(int) - drawn).max() < 4
        for other in ({"camera": CameraName.REAR}, {"sequence": 6}, {"stamp_s": 0.34}):
            assert recording.picture(exact.model_copy(update=other)) is None


def test_pictures_of_both_cameras_come_with_their_frames(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    record(made_up.picture(number / 3, number, 100, camera) for number in range(3) for camera in CameraName)

    with Recording.open(directory) as recording:
        pictures = list(recording.pictures())
    assert [(one.seen.camera, one.seen.sequence) for one in pictures] == [
        (camera, number) for number in range(3) for camera in CameraName
    ]
    assert [one.seen.stamp_s for one in pictures[::2]] == pytest.approx([0, 1 / 3, 2 / 3], abs=1e-9)
    assert [one.jpeg for one in pictures[::2]] == [made_up.jpeg(number, 100) for number in range(3)]


def test_a_picture_that_is_none_is_named(directory: RunDirectory) -> None:
    seen = Seen(camera=CameraName.REAR, sequence=3, stamp_s=1.0)

    for jpeg in (b"", b"no picture"):
        with pytest.raises(FieldnavError, match="recorded frame 3 of the rear camera: is no JPEG"):
            Picture(seen, jpeg).image()


def test_a_record_that_is_none_is_named(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    record([made_up.item([Message(Topic.TICK, 0.0, b"{}")])])

    with (
        Recording.open(directory) as recording,
        pytest.raises(FieldnavError, match=r"mcap: the message on /mission/tick at 0\.0 s is none"),
    ):
        list(recording.ticks())


@pytest.mark.parametrize("broken_off", [False, True])
def test_a_long_recording_is_opened_and_searched_without_being_read(
    broken_off: bool, directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    record(made_up.items(1600, picture_bytes=200_000))
    path = directory.recording
    if broken_off:
        with path.open("r+b") as file:
            file.truncate(path.stat().st_size - 100_000)
    size, counted = path.stat().st_size, Counted()

    with Recording.open(directory, counted) as recording:
        assert counted.bytes < (0.02 if broken_off else 0.002) * size
        ticks = list(recording.ticks(10.0, 12.0))

    assert size > 6e7
    assert len(ticks) == 101
    assert counted.bytes < 0.03 * size
