"""Records the golden runs anew: `python tests/golden/make.py [NAME...]`, from the project's folder.

Do this when a transition is meant to come out otherwise, and read the difference that the test shows first.
Pictures are small, few and much compressed, and what a replay does not need is left out.
"""

import lzma
import shutil
import sys
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.messages import Side
from fieldnav.mission.simulated import Run, simulate
from fieldnav.recording.message import Topic
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Robot

HERE = Path(__file__).parent
NEEDED = (Topic.ROUND, Topic.FRONT_IMAGE, Topic.REAR_IMAGE)
RUNS: Mapping[str, tuple[str, Mapping[str, Any]]] = {
    "two-lanes": ("demo", {"lanes": 2, "length_m": 4}),
    "two-broad-rows": ("demo", {"lanes": 2, "length_m": 4, "crop": "potato"}),
    "gap": ("sim-large-gaps", {"lanes": 1, "length_m": 8}),
    "refused": ("sim-dense-weed", {"lanes": 2, "length_m": 4, "seed": 2}),
}
"""By name: the field, and what is changed in it."""


def small_robot() -> Robot:
    """bonnbot with pictures of a sixteenth of their size, half as many."""
    small = smaller(load_robot("bonnbot"), 4)
    cameras = small.model_dump(mode="json")["cameras"]
    for camera in cameras.values():
        camera["rate_hz"] /= 2
    return revised(small, {"cameras": cameras, "recording": {"quality": 75}})


def make(name: str) -> None:
    """Drive one golden run and put it beside this file."""
    field_name, changes = RUNS[name]
    field = revised(load_field(field_name), changes)
    crop, robot = load_crop(field.crop), small_robot()
    with TemporaryDirectory() as folder:
        run = Run(field, crop, robot, field.lanes, Side.RIGHT, Path(folder), sketch=True, record=True)
        done = simulate(run)
        kept = HERE / name
        kept.mkdir(exist_ok=True)
        for path in (done.directory.journal, done.directory.settings):
            shutil.copyfile(path, kept / path.name)
        (kept / "recording.mcap.xz").write_bytes(lzma.compress(needed(done.directory.recording)))
    print(f"{name}: completed {done.summary.completed}, {done.summary.transitions} transitions")


def needed(path: Path) -> bytes:
    """The part of a recording that a replay needs, as a recording."""
    with TemporaryDirectory() as folder, path.open("rb") as source:
        reader, written = make_reader(source), Path(folder) / path.name
        writer = Writer(str(written), compression=CompressionType.NONE)
        writer.start()
        for metadata in reader.iter_metadata():
            writer.add_metadata(metadata.name, metadata.metadata)
        channels: dict[int, int] = {}
        topics = [topic.value for topic in NEEDED]
        for schema, channel, message in reader.iter_messages(topics, log_time_order=False):
            if channel.id not in channels:
                assert schema is not None, "every topic of a recording has a schema"
                kind = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[channel.id] = writer.register_channel(channel.topic, channel.message_encoding, kind)
            writer.add_message(
                channels[channel.id],
                message.log_time,
                message.data,
                message.publish_time,
                message.sequence,
            )
        writer.finish()
        return written.read_bytes()


if __name__ == "__main__":
    for asked in sys.argv[1:] or RUNS:
        make(asked)
