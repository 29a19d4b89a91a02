"""A recording goes on from file to file, keeps to its budget, and ends before the disk is full."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import CameraName
from fieldnav.recording.foxglove import calibration
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.opening import existing_file
from fieldnav.recording.piece_names import pieces_in
from fieldnav.recording.piece_reader import PieceReader
from fieldnav.recording.recording import Recording
from fieldnav.settings.loading import load_robot

PICTURE_BYTES = 200_000
TICKS = 100
"""Of 4 MB of pictures."""

FOREVER = 1 << 62


def names(directory: RunDirectory) -> list[str]:
    return [path.name for path in pieces_in(directory).values()]


def test_past_a_size_a_new_file_is_begun_and_all_are_read_as_one(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    record(made_up.items(TICKS, PICTURE_BYTES), {"piece_mb": 1})

    assert names(directory) == ["recording.mcap", *(f"recording-000{number}.mcap" for number in (2, 3, 4))]
    assert all(path.stat().st_size < 2.5e6 for path in pieces_in(directory).values())
    with Recording.open(directory) as recording:
        assert [tick.now_s for tick in recording.ticks()] == [number * 0.02 for number in range(TICKS)]
        assert [one.seen.sequence for one in recording.pictures(0.5, 1.0)] == [25, 30, 35, 40, 45, 50]
        assert (recording.begin_s, recording.end_s) == (0.0, (TICKS - 1) * 0.02)


def test_a_run_that_is_taken_up_goes_on_in_the_next_file(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    record(made_up.items(10))
    first = directory.recording.read_bytes()

    record(made_up.items(10, first=100))

    assert names(directory) == ["recording.mcap", "recording-0002.mcap"]
    assert directory.recording.read_bytes() == first
    with Recording.open(directory) as recording:
        assert [tick.now_s for tick in recording.ticks(0.18, 2.0)] == [0.18, 2.0]


def test_past_the_budget_the_oldest_files_give_way_and_it_is_said(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    with recorder({"piece_mb": 1, "budget_gb": 0.005}) as recording:
        for item in made_up.items(5 * TICKS, PICTURE_BYTES):
            recording.put(item)

    left = pieces_in(directory)
    assert recording.failure is None
    assert 1 not in left
    assert sum(path.stat().st_size for path in left.values()) < 5e6 + 2.5e6
    assert recording.notes[0] == (
        f"{directory.recording}: gave way to newer ones; robot.recording.budget_gb is 0.005"
    )
    with Recording.open(directory) as read:
        assert read.begin_s > 5.0
        assert read.end_s == (5 * TICKS - 1) * 0.02


def test_the_newest_file_never_gives_way(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    record(made_up.items(3 * TICKS, PICTURE_BYTES), {"piece_mb": 100, "budget_gb": 0.001})

    assert names(directory) == ["recording.mcap"]


def test_a_disk_with_little_left_ends_the_recording_with_a_complete_file(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    left = iter([5e9, 5e9, 1.9e9])

    with recorder({"keep_free_gb": 2}, free=lambda folder: next(left)) as recording:
        for item in made_up.items(5 * TICKS):
            recording.put(item)

    assert recording.failure == (
        f"{directory.path}: recording has ended: the disk has 1.9 GB left; robot.recording.keep_free_gb is 2"
    )
    content = directory.recording.read_bytes()
    with Recording.open(directory) as read:
        assert read.end_s == 1.98, "it was looked at 0, 1 and 2 s"
    assert directory.recording.read_bytes() == content, "nothing had to be mended"


def test_a_disk_with_little_left_begins_no_recording(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    with recorder({"keep_free_gb": 2}, free=lambda folder: 1) as recording:
        recording.put(made_up.tick(0.0))

    assert "the disk has 0.0 GB left" in recording.failure
    assert names(directory) == []


def test_every_file_says_how_the_cameras_see(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    pinhole = load_robot("bonnbot").cameras.get(CameraName.FRONT).pinhole()
    data = calibration(CameraName.FRONT, made_up.begun, pinhole)
    said = made_up.item([Message(Topic.FRONT_CALIBRATION, 0.0, data)])

    record([said, *made_up.items(TICKS, PICTURE_BYTES)], {"piece_mb": 1})

    for path in pieces_in(directory).values():
        reader = PieceReader(path, existing_file)
        assert [one.data for one in reader.messages([Topic.FRONT_CALIBRATION], 0, FOREVER)] == [data]
        begin_ns, _ = reader.span_ns
        assert begin_ns > reader.stamps.to_ns(0.0) or path == directory.recording
        reader.close()


def test_other_files_beside_it_are_no_part_of_a_recording(tmp_path: Path) -> None:
    for name in ("recording-2.mcap", "recording-copy.mcap", "recording-0002.mcap.bak", "export.mcap"):
        (tmp_path / name).write_text("")

    assert Recording.open(RunDirectory(tmp_path)) is None
