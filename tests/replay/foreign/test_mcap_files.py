"""MCAP files as others write them: what is optional may lack, what lies beside may be unreadable."""

import struct
from collections.abc import Callable
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from google.protobuf.timestamp_pb2 import Timestamp
from mcap.writer import CompressionType, IndexType, Writer
from mcap_protobuf.schema import build_file_descriptor_set

from fieldnav.errors import SettingsError
from fieldnav.replay.foreign.joined import Joined, mcap_files
from fieldnav.replay.foreign.mcap_file import McapFile

TOPIC, COUNT = "/cam", 20
BEGUN_NS, FRAME_NS = 1_700_000_000_000_000_000, 66_000_000
MAGIC_BYTES = 8
HEAD = struct.Struct("<BQ")
PICTURES = [b"%d" % number * 50 for number in range(COUNT)]
UNKNOWN_OPCODES = (0x7F, 0x80, 0xFF)


def written(beside: Callable[[Writer], None] = lambda writer: None, **options: Any) -> bytes:
    """A file with pictures on one topic; beside: writes what else there is. Small chunks, unless told."""
    file = BytesIO()
    writer = Writer(file, **({"chunk_size": 300} | options))
    writer.start()
    beside(writer)
    data = build_file_descriptor_set(CompressedImage).SerializeToString()
    schema = writer.register_schema("foxglove.CompressedImage", "protobuf", data)
    channel = writer.register_channel(TOPIC, "protobuf", schema)
    for number, picture in enumerate(PICTURES):
        at_ns = BEGUN_NS + number * FRAME_NS
        stamp = Timestamp(seconds=at_ns // 10**9, nanos=at_ns % 10**9)
        message = CompressedImage(timestamp=stamp, data=picture, format="jpeg").SerializeToString()
        writer.add_message(channel, at_ns, message, at_ns)
    writer.finish()
    return file.getvalue()


def records(content: bytes) -> list[tuple[int, bytes]]:
    """The opcode and the bytes, head included, of each record."""
    found, at = [], MAGIC_BYTES
    while at < len(content) - MAGIC_BYTES:
        opcode, length = HEAD.unpack_from(content, at)
        found.append((opcode, content[at : at + HEAD.size + length]))
        at += HEAD.size + length
    return found


def opened(content: bytes, folder: Path) -> McapFile:
    path = folder / "other.mcap"
    path.write_bytes(content)
    return McapFile(path)


def pictures(file: McapFile) -> list[bytes]:
    return [each.content.data for each in file.read(TOPIC)]


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"repeat_channels": False},
        {"repeat_schemas": False},
        {"repeat_channels": False, "repeat_schemas": False},
        {"use_statistics": False},
        {"use_summary_offsets": False},
        {"index_types": IndexType.NONE},
        {"index_types": IndexType.CHUNK},
        {"index_types": IndexType.MESSAGE},
        {
            "index_types": IndexType.NONE,
            "repeat_channels": False,
            "repeat_schemas": False,
            "use_statistics": False,
            "use_summary_offsets": False,
        },
        {"use_chunking": False},
        {"use_chunking": False, "use_statistics": False, "index_types": IndexType.NONE},
        {"enable_crcs": False},
    ],
    ids=str,
)
@pytest.mark.parametrize("compression", list(CompressionType))
def test_every_optional_part_may_lack(
    options: dict[str, Any], compression: CompressionType, tmp_path: Path
) -> None:
    file = opened(written(compression=compression, **options), tmp_path)

    assert file.topics == {TOPIC: "foxglove.CompressedImage"}
    assert file.counts[TOPIC] == COUNT and file.seconds == pytest.approx((COUNT - 1) * FRAME_NS / 1e9)
    assert pictures(file) == PICTURES


def test_a_file_without_any_summary_is_read(tmp_path: Path) -> None:
    content = written()
    data = b"".join(
        whole for _, whole in records(content[: content.index(b"\x0f\x04\0\0\0\0\0\0\0")] + bytes(8))
    )
    end = HEAD.pack(0x0F, 4) + bytes(4) + HEAD.pack(0x02, 20) + bytes(20)

    assert pictures(opened(content[:8] + data + end + content[:8], tmp_path)) == PICTURES


def test_records_that_nobody_knows_and_chunks_of_nothing_are_passed_over(tmp_path: Path) -> None:
    content = written(use_statistics=False)
    nothing = struct.pack("<QQQI", 0, 0, 0, 0) + struct.pack("<I", 4) + b"zstd" + struct.pack("<Q", 0)
    strange = HEAD.pack(0x06, len(nothing)) + nothing
    strange += b"".join(HEAD.pack(opcode, 3) + b"abc" for opcode in UNKNOWN_OPCODES)
    footer = HEAD.pack(0x02, 20) + bytes(20)  # without a summary, whose places would be others
    whole = content[:8]
    for opcode, record in records(content):
        if opcode == 0x0F:
            whole += record + footer + content[:8]
            break
        whole += record + strange

    assert pictures(opened(whole, tmp_path)) == PICTURES


def attachments(writer: Writer) -> None:
    writer.add_attachment(BEGUN_NS, BEGUN_NS, "calibration", "text/plain", b"fx 900")
    writer.add_metadata("robot", {"name": "thorvald"})


def other_topics(writer: Writer) -> None:
    """Of encodings that nobody knows, and of schemas that cannot be parsed."""
    for number, (name, encoding, data, message_encoding) in enumerate(
        [
            ("lidar/Scan", "ros2msg", b"float32[ ranges\nnone/Such thing\n\xff", "cdr"),
            ("theora_image_transport/msg/Packet", "ros2msg", b"", "cdr"),
            ("ffmpeg_image_transport_msgs/msg/FFMPEGPacket", "ros2idl", b"module {", "cdr"),
            ("foxglove.CompressedVideo", "protobuf", b"\xff\xff", "protobuf"),
            ("foxglove.CompressedImage", "jsonschema", b"{", "json"),
            ("strange", "capnp", b"\0", "capnp"),
        ]
    ):
        schema = writer.register_schema(name, encoding, data)
        channel = writer.register_channel(f"/other{number}", message_encoding, schema)
        writer.add_message(channel, BEGUN_NS, b"\xff\0\xff", BEGUN_NS)
    writer.add_message(writer.register_channel("/bare", "json", 0), BEGUN_NS, b"{}", BEGUN_NS)


@pytest.mark.parametrize("beside", [attachments, other_topics])
@pytest.mark.parametrize("options", [{}, {"use_statistics": False}, {"use_chunking": False}], ids=str)
def test_what_lies_beside_the_pictures_need_not_be_readable(
    beside: Callable[[Writer], None], options: dict[str, Any], tmp_path: Path
) -> None:
    assert pictures(opened(written(beside, **options), tmp_path)) == PICTURES


@pytest.mark.parametrize("options", [{}, {"use_statistics": False}], ids=str)
def test_a_flipped_byte_in_a_chunk_is_told_after_the_pictures_before_it(
    options: dict[str, Any], tmp_path: Path
) -> None:
    content = bytearray(written(compression=CompressionType.NONE, **options))
    content[content.index(PICTURES[12]) + 7] ^= 1
    file = opened(bytes(content), tmp_path)
    found = []

    with pytest.raises(SettingsError, match=r"the chunk at byte \d+ does not fit its checksum; allowed is"):
        found.extend(each.content.data for each in file.read(TOPIC))

    assert found == PICTURES[: len(found)] and 8 <= len(found) <= 12 and file.counts[TOPIC] >= len(found)


@pytest.mark.parametrize("share", [0.4, 0.5, 0.6])
def test_a_file_that_breaks_off_is_read_up_to_there_and_then_told(share: float, tmp_path: Path) -> None:
    content = written(compression=CompressionType.NONE)
    file = opened(content[: round(share * len(content))], tmp_path)
    found = []

    with pytest.raises(
        SettingsError, match=r"other\.mcap: cannot be read: it breaks off at byte \d+; allowed is"
    ):
        found.extend(each.content.data for each in file.read(TOPIC))

    assert found == PICTURES[: len(found)] and len(found) >= share * COUNT / 2


def test_a_compression_that_nobody_knows_is_named(tmp_path: Path) -> None:
    content = written(compression=CompressionType.LZ4).replace(b"lz4", b"br4")

    with pytest.raises(SettingsError, match=r"compressed by 'br4'; known are none, lz4, zstd"):
        opened(content, tmp_path)


def test_one_flip_anywhere_is_read_as_it_was_or_told_in_one_line(tmp_path: Path) -> None:
    content = written(compression=CompressionType.NONE)
    for place in range(MAGIC_BYTES, len(content), 7):
        flipped = bytearray(content)
        flipped[place] ^= 0x10
        try:
            file = opened(bytes(flipped), tmp_path)
            found = pictures(file) if file.topics.get(TOPIC) == "foxglove.CompressedImage" else None
        except SettingsError as error:
            assert "\n" not in str(error), place
            continue
        assert found in (PICTURES, None), place


def test_the_files_of_a_bag_of_ros_2_are_one_recording(tmp_path: Path) -> None:
    names = [f"bag_{number}.mcap" for number in range(3)]
    for name in names:
        (tmp_path / name).write_bytes(written())
    listed = "".join(f"    - {name}\n" for name in names)
    (tmp_path / "metadata.yaml").write_text(
        "rosbag2_bagfile_information:\n  storage_identifier: mcap\n  compression_mode: ''\n"
        f"  relative_file_paths:\n{listed}"
    )

    files = mcap_files(tmp_path)
    joined = Joined("bag", [McapFile(each) for each in files])

    assert [each.name for each in files] == names
    assert joined.counts == {TOPIC: 3 * COUNT} and joined.topics == {TOPIC: "foxglove.CompressedImage"}
    assert [each.content.data for each in joined.read(TOPIC)] == 3 * PICTURES
    (tmp_path / "metadata.yaml").write_text("rosbag2_bagfile_information: [")
    assert mcap_files(tmp_path) == []
    (tmp_path / "metadata.yaml").unlink()
    (tmp_path / names[0]).rename(tmp_path / "bag_10.mcap")
    assert [each.name for each in mcap_files(tmp_path)] == [*names[1:], "bag_10.mcap"]
    (tmp_path / "0.jpg").touch()
    assert mcap_files(tmp_path) == []


def test_places_are_those_of_the_file(tmp_path: Path) -> None:
    places = [each.at for each in opened(written(use_statistics=False), tmp_path)._index.places]

    assert all(one < two for one, two in pairwise(places)) and len(places) > 3
