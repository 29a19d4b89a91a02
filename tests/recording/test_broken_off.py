"""A recording that broke off at any byte opens to its last whole message, and has an end afterwards."""

import fcntl
import os
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from mcap.data_stream import RecordBuilder
from mcap.reader import make_reader
from mcap.records import Message
from mcap.stream_reader import StreamReader, breakup_chunk

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.recording.message import Topic
from fieldnav.recording.opening import MOST_TORN_BYTES, existing_file
from fieldnav.recording.piece_names import piece_path
from fieldnav.recording.piece_reader import PieceReader
from fieldnav.recording.recording import Recording
from fieldnav.recording.survey import survey

CUTS = 200
SEED = 20260501
CHUNK_HEAD_BYTES = 9 + 40
FOREVER = 1 << 62

Told = tuple[str, int, int, bytes]
"""A message: topic, nanoseconds, sequence, content."""


@pytest.fixture
def whole(directory: RunDirectory, record: Callable[..., None], made_up: Any) -> bytes:
    """A recording of two seconds."""
    record(made_up.items(100))
    return directory.recording.read_bytes()


def in_file(path: Path) -> list[Told]:
    """The messages in written order, by the library's own reader."""
    with path.open("rb") as file:
        found = make_reader(file, validate_crcs=True).iter_messages()
        return [(channel.topic, one.log_time, one.sequence, one.data) for _, channel, one in found]


def as_read(path: Path) -> list[Told]:
    """The messages by time, as a recording reads them."""
    reader = PieceReader(path, existing_file)
    try:
        found = list(reader.messages(list(Topic), 0, FOREVER))
    finally:
        reader.close()
    told = [(one.topic.value, one.log_time_ns, one.sequence, one.data) for one in found]
    return sorted(told, key=lambda one: one[1])


def ends(path: Path) -> list[tuple[int, Told]]:
    """Every message with the byte at which it ends, from the library's chunks."""
    found = []
    with path.open("rb") as file:
        summary = make_reader(file).get_summary()
        for index in summary.chunk_indexes:
            file.seek(index.chunk_start_offset)
            chunk = next(StreamReader(file, skip_magic=True, emit_chunks=True).records)
            at = index.chunk_start_offset + CHUNK_HEAD_BYTES
            for one in breakup_chunk(chunk):
                builder = RecordBuilder()
                one.write(builder)
                at += builder.count
                if isinstance(one, Message):
                    topic = summary.channels[one.channel_id].topic
                    found.append((at, (topic, one.log_time, one.sequence, one.data)))
    return found


def cut_places(size: int) -> list[int]:
    """Random ones, and all those within the magic bytes at both ends and within the footer."""
    chance = random.Random(SEED)
    return [*range(12), *range(size - 40, size), *(chance.randrange(size) for _ in range(CUTS))]


def test_a_recording_cut_anywhere_opens_to_the_last_message_that_was_whole(
    directory: RunDirectory, whole: bytes
) -> None:
    path = directory.recording
    messages = ends(path)
    assert len(messages) == 120
    for place in cut_places(len(whole)):
        expected = sorted((told for end, told in messages if end <= place), key=lambda told: told[1])
        path.write_bytes(whole[:place])

        assert as_read(path) == expected, f"cut at {place}, opened for the first time"
        with path.open("rb") as file:
            summary = make_reader(file).get_summary()
        assert summary is not None, f"cut at {place}"
        assert summary.statistics.message_count == len(expected), f"cut at {place}"
        assert in_file(path) == expected, f"cut at {place}, by the library"
        assert as_read(path) == expected, f"cut at {place}, opened again"


def test_a_recording_cut_anywhere_is_read_without_being_mended_while_another_holds_it(
    directory: RunDirectory, whole: bytes
) -> None:
    path = directory.recording
    messages = ends(path)
    for place in cut_places(len(whole))[::4]:
        expected = sorted((told for end, told in messages if end <= place), key=lambda told: told[1])
        path.write_bytes(whole[:place])
        with path.open("rb") as held:
            fcntl.flock(held, fcntl.LOCK_EX)

            assert as_read(path) == expected, f"cut at {place}"

        assert path.read_bytes() == whole[:place], f"cut at {place}"


def test_a_mending_that_breaks_off_itself_loses_nothing(directory: RunDirectory, whole: bytes) -> None:
    path = directory.recording
    messages = ends(path)
    torn_at = messages[70][0] + 20
    expected = sorted((told for end, told in messages if end <= torn_at), key=lambda told: told[1])
    path.write_bytes(whole[:torn_at])
    with existing_file(path) as file:
        found = survey(file)
    as_read(path)
    mended = path.read_bytes()
    assert found.torn
    head_only = mended[: found.whole_to] + whole[found.whole_to : torn_at]
    chance = random.Random(SEED)
    broken = [mended[: chance.randrange(found.whole_to, len(mended))] for _ in range(CUTS // 4)]
    for number, state in enumerate([head_only, *broken]):
        path.write_bytes(state)

        assert as_read(path) == expected, number
        assert in_file(path) == expected, number


def test_rubbish_after_the_last_message_is_cut_off(directory: RunDirectory, whole: bytes) -> None:
    path = directory.recording
    messages = ends(path)
    end = messages[50][0]
    expected = sorted((told for until, told in messages if until <= end), key=lambda told: told[1])
    for rubbish in (bytes(5000), b"\xff" * 5000, random.Random(SEED).randbytes(5000)):
        path.write_bytes(whole[:end] + rubbish)

        assert as_read(path) == expected
        assert in_file(path) == expected


def test_a_damaged_recording_is_told_in_one_line_or_read(directory: RunDirectory, whole: bytes) -> None:
    path, chance = directory.recording, random.Random(SEED)
    for number in range(CUTS):
        content = bytearray(whole[: chance.choice([len(whole), chance.randrange(len(whole))])])
        for _ in range(3):
            content[chance.randrange(len(content))] = chance.randrange(256)
        path.write_bytes(content)

        try:
            with Recording.open(directory) as recording:
                list(recording.ticks())
                list(recording.pictures())
        except FieldnavError as error:
            assert str(path.parent) in str(error) or "recorded frame" in str(error), number
            assert "\n" not in str(error), number


def test_a_recording_that_is_being_written_is_read_and_left_alone(
    directory: RunDirectory, recorder: Callable[..., Any], made_up: Any
) -> None:
    with recorder() as writing:
        for item in made_up.items(100):
            writing.put(item)
        while not directory.recording.exists() or directory.recording.stat().st_size < 20_000:
            writing.put(made_up.tick(3.0))

        with Recording.open(directory) as running:
            seen = [tick.now_s for tick in running.ticks()]

    assert seen[:5] == [number * 0.02 for number in range(5)]
    with Recording.open(directory) as complete:
        assert len(list(complete.ticks())) >= 100
    assert writing.failure is None


def test_a_file_that_is_no_recording_is_named(directory: RunDirectory) -> None:
    directory.recording.write_text("a diary")

    with pytest.raises(FieldnavError, match=r"recording\.mcap: is no recording; allowed is an MCAP file"):
        Recording.open(directory)


def test_a_pipe_is_refused_instead_of_waited_for(directory: RunDirectory) -> None:
    os.mkfifo(directory.recording)

    with pytest.raises(FieldnavError, match=r"recording\.mcap: cannot be read: is no file on a disk"):
        Recording.open(directory)


def test_the_piece_that_cannot_be_read_is_named(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    record(made_up.items(10))
    piece_path(directory, 2).mkdir()

    with pytest.raises(FieldnavError, match=r"recording-0002\.mcap: cannot be read: Is a directory"):
        Recording.open(directory)


def test_what_no_power_loss_tears_off_is_not_cut_off(directory: RunDirectory, whole: bytes) -> None:
    path = directory.recording
    messages = ends(path)
    end = messages[50][0]
    path.write_bytes(whole[:end])
    os.truncate(path, end + MOST_TORN_BYTES)
    with path.open("ab") as file:
        file.write(whole)

    read = as_read(path)

    assert len(read) == 51
    assert path.stat().st_size == end + MOST_TORN_BYTES + len(whole)
    os.truncate(path, end + MOST_TORN_BYTES // 2)
    assert as_read(path) == read
    assert path.stat().st_size < MOST_TORN_BYTES // 2
