"""The recorder writes in order beside the loop; what it cannot do it says, and it never raises."""

from collections.abc import Callable
from errno import ENOSPC
from io import BufferedWriter, FileIO
from pathlib import Path
from threading import Event
from typing import Any, BinaryIO

from fieldnav.journal.directory import RunDirectory
from fieldnav.recording.leaving_out import LeavingOut
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.queue import Waiting
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Gap

MEGABYTE = 1_000_000


class Disk:
    """A disk that stalls while it is not `going`, and is full after so many bytes."""

    def __init__(self, room_bytes: int = 1 << 40) -> None:
        self.going, self.room_bytes = Event(), room_bytes

    def __call__(self, path: Path) -> BinaryIO:
        return BufferedWriter(FileOnDisk(path, self))


class FileOnDisk(FileIO):
    def __init__(self, path: Path, disk: Disk) -> None:
        super().__init__(path, "xb")
        self.disk = disk

    def write(self, content: Any, /) -> int:
        self.disk.going.wait()
        if not self.disk.room_bytes:
            raise OSError(ENOSPC, "No space left on device")
        written = super().write(bytes(content)[: self.disk.room_bytes])
        self.disk.room_bytes -= written
        return written


def test_what_is_put_is_written_in_that_order(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    stamps = [0.0, 0.02, 0.02, 0.01, 0.5, 0.3]

    record(made_up.tick(stamp_s) for stamp_s in stamps)

    with Recording.open(directory) as recording:
        assert [tick.now_s for tick in recording.ticks()] == stamps


def test_a_stalled_disk_costs_pictures_but_no_ticks_and_leaves_a_gap(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    disk = Disk()
    recording = recorder({"queue_mb": 8}, waits=False, opening=disk)
    for number in range(20):
        recording.put(made_up.picture(number / 10, number, MEGABYTE))
        recording.put(made_up.tick(number / 10))
    disk.going.set()
    recording.close()

    assert recording.failure is None
    assert recording.notes == ("the disk is too slow: from 0.6 s on 13 pictures are not in the recording",)
    with Recording.open(directory) as read:
        assert [tick.now_s for tick in read.ticks()] == [number / 10 for number in range(20)]
        assert [picture.seen.sequence for picture in read.pictures()] == list(range(7))
        assert list(read.gaps()) == [Gap(from_s=0.6, to_s=1.9, frames=13)]


def test_one_that_waits_for_a_stalled_disk_loses_nothing(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    disk = Disk()
    disk.going.set()
    with recorder({"queue_mb": 8}, opening=disk) as recording:
        for number in range(20):
            recording.put(made_up.picture(number / 10, number, MEGABYTE))

    with Recording.open(directory) as read:
        assert [picture.seen.sequence for picture in read.pictures()] == list(range(20))
        assert list(read.gaps()) == []


def test_a_gap_ends_with_the_next_picture(made_up: Any) -> None:
    leaving_out = LeavingOut()
    leaving_out.written(Message(Topic.TICK, 1.0, b""))
    leaving_out.before(Waiting(made_up.tick(1.02), 0, pictures_before=2, others_before=0))
    leaving_out.written(Message(Topic.TICK, 1.02, b""))
    leaving_out.before(Waiting(made_up.picture(1.5, 9), 0, pictures_before=1, others_before=4))

    gap = Gap.model_validate_json(leaving_out.gap(1.5).data)

    assert gap == Gap(from_s=1.0, to_s=1.5, frames=3)
    assert leaving_out.gap(1.6) is None
    assert leaving_out.notes == (
        "the disk is too slow: from 1.0 s on 3 pictures and 4 records without which it cannot be replayed "
        "are not in the recording",
    )


def test_a_full_disk_ends_the_recording_and_what_was_written_is_read(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    disk = Disk(room_bytes=3_500_000)
    disk.going.set()
    recording = recorder(opening=disk)
    for number in range(10):
        recording.put(made_up.picture(number / 10, number, MEGABYTE))
    recording.close()
    recording.put(made_up.tick(2.0))
    recording.close()

    path = directory.recording
    assert recording.failure == f"{path}: cannot be written: No space left on device"
    with Recording.open(directory) as read:
        assert [picture.seen.sequence for picture in read.pictures()] == [0, 1, 2]


def test_a_folder_that_cannot_be_written_ends_the_recording(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    directory.path.rmdir()

    with recorder() as recording:
        recording.put(made_up.tick(0.0))

    assert "No such file or directory" in recording.failure


def test_an_item_that_cannot_become_messages_ends_the_recording(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    recording = recorder()
    recording.put(made_up.tick(0.0))
    recording.put(made_up.item([Message(Topic.TICK, 0.02, "no bytes")]))
    recording.close()

    assert recording.failure.startswith(f"{directory.recording}: recording has ended: TypeError")
    with Recording.open(directory) as read:
        assert [tick.now_s for tick in read.ticks()] == [0.0]
