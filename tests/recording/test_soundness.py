"""A recording with a flipped byte is told to be damaged, or is read as it was."""

import random
from collections.abc import Callable
from typing import Any

import pytest

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.recording.message import Topic
from fieldnav.recording.opening import existing_file
from fieldnav.recording.piece_names import piece_path
from fieldnav.recording.piece_reader import PieceReader, Read
from fieldnav.recording.recording import Recording
from fieldnav.recording.walk import records

SEED, FLIPS, BITS = 20261130, 150, 8
FOREVER = 1 << 62


@pytest.fixture
def whole(directory: RunDirectory, record: Callable[..., None], made_up: Any) -> bytes:
    """A recording of two seconds."""
    record(made_up.items(100, picture_bytes=200))
    return directory.recording.read_bytes()


def read(directory: RunDirectory) -> list[Read]:
    """All messages of a recording that was found sound."""
    reader = PieceReader(directory.recording, existing_file)
    try:
        reader.check()
        return list(reader.messages(list(Topic), 0, FOREVER))
    finally:
        reader.close()


def places(directory: RunDirectory, whole: bytes) -> list[int]:
    """The head of every record, the end, and random ones."""
    chance = random.Random(SEED)
    with existing_file(directory.recording) as file:
        every = [each.at for each in records(file, 8, len(whole) - 8)]
    heads = [at + byte for at in every[::3] for byte in (0, 1, 3, 9, 11, 20)]
    return [*range(12), *heads, *range(len(whole) - 40, len(whole)), *chance.sample(range(len(whole)), FLIPS)]


def test_a_whole_recording_is_sound(directory: RunDirectory, whole: bytes) -> None:
    assert len(read(directory)) == 120


def test_a_bit_flipped_anywhere_is_told_in_one_line_or_changes_nothing(
    directory: RunDirectory, whole: bytes
) -> None:
    expected, chance = read(directory), random.Random(SEED)
    told = 0
    for place in places(directory, whole):
        flipped = bytearray(whole)
        flipped[place] ^= 1 << chance.randrange(BITS)
        directory.recording.write_bytes(flipped)
        try:
            assert read(directory) == expected, place
        except FieldnavError as error:
            told += 1
            assert str(error).startswith(str(directory.recording)) and "\n" not in str(error), place
    assert told > FLIPS / 2


def test_a_recording_that_broke_off_is_sound_until_a_byte_of_its_messages_flips(
    directory: RunDirectory, whole: bytes
) -> None:
    directory.recording.write_bytes(whole[: len(whole) // 2])
    expected = read(directory)
    mended = bytearray(directory.recording.read_bytes())
    assert 20 < len(expected) < 100

    mended[len(mended) // 4] ^= 1
    directory.recording.write_bytes(mended)

    with pytest.raises(FieldnavError, match=r"is damaged: .*chunk at byte \d+"):
        read(directory)


def test_a_recording_that_is_being_written_is_sound(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    with recorder() as writing:
        for item in made_up.items(100):
            writing.put(item)
        while not directory.recording.exists() or directory.recording.stat().st_size < 20_000:
            writing.put(made_up.tick(3.0))

        with Recording.open(directory) as running:
            running.check()

    with Recording.open(directory) as complete:
        complete.check()


def test_a_file_that_lacks_among_others_is_named(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    record(made_up.items(400, picture_bytes=100_000), {"piece_mb": 1})
    with Recording.open(directory) as complete:
        assert complete.lacking == []
    piece_path(directory, 2).unlink()
    piece_path(directory, 4).unlink()

    with Recording.open(directory) as recording:
        assert recording.lacking == ["recording-0002.mcap", "recording-0004.mcap"]
