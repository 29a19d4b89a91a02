"""Each topic says what its messages are, in a way that Foxglove takes."""

import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from fieldnav.faults import FaultKind
from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import CameraName, Wheel
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.records import Call, Lost, Module, Round, Seen, Stepped, Wire
from fieldnav.recording.schemas import PROTOBUF, RECORDS, schema_of

NUMBERS = {"number": (int, float), "integer": int}
TYPES = NUMBERS | {"object": dict, "array": list, "string": str, "boolean": bool}


def refused(schema: dict[str, Any], path: str = "") -> Iterator[str]:
    """What Foxglove does not take: anything without exactly one type, objects that name no values."""
    kind = schema.get("type")
    if kind not in TYPES or schema.keys() & {"$ref", "anyOf", "oneOf", "allOf"}:
        yield path
    if kind == "object":
        for name, value in schema["properties"].items():
            yield from refused(value, f"{path}.{name}")
    if kind == "array":
        if schema["items"]["type"] == "array":
            yield path
        yield from refused(schema["items"], f"{path}[]")


def unsaid(value: Any, schema: dict[str, Any], path: str = "") -> Iterator[str]:
    """What a message holds and its schema does not say; null stands for any type."""
    if value is None:
        return
    if not isinstance(value, TYPES[schema["type"]]):
        yield path
    elif isinstance(value, dict):
        for name, inner in value.items():
            known = schema["properties"].get(name)
            yield from unsaid(inner, known, f"{path}.{name}") if known else [f"{path}.{name}"]
    elif isinstance(value, list):
        for inner in value:
            yield from unsaid(inner, schema["items"], f"{path}[]")


@pytest.mark.parametrize("topic", RECORDS)
def test_the_schemas_of_records_are_such_as_foxglove_takes(topic: Topic) -> None:
    schema = schema_of(topic)

    assert (schema.encoding, schema.message_encoding) == ("jsonschema", "json")
    assert list(refused(json.loads(schema.data))) == []


def test_a_record_holds_what_its_schema_says(made_up: Any) -> None:
    seen = Seen(camera=CameraName.FRONT, sequence=3, stamp_s=1.5)
    lost = Lost(camera=CameraName.REAR, fault=FaultKind.CAMERA_BLACK, said="it is dark")
    module = Module(set_speed_mps=0.5, battery_v=48.0)
    examples = {
        Topic.ROUND: Round(call=Call.TICK, now_s=2.0, frames=(seen,), lost=(lost,), wires=(Wire(sent=True),)),
        Topic.TICK: made_up.ticked(2.0).model_copy(update={"modules": dict.fromkeys(Wheel, module)}),
        Topic.STEP: Stepped(now_s=2.0, state="Idle", lane=0, forward_m=0.0, frame=seen, plants=4),
    }
    for topic, record in examples.items():
        schema = json.loads(schema_of(topic).data)

        assert list(unsaid(json.loads(record.model_dump_json()), schema)) == []


def test_a_topic_has_either_a_record_or_a_message_of_foxglove() -> None:
    assert RECORDS.keys() | PROTOBUF.keys() == set(Topic)
    assert not RECORDS.keys() & PROTOBUF.keys()


def test_a_reader_that_knows_nothing_of_us_decodes_every_topic(
    directory: RunDirectory, record: Callable[..., None], made_up: Any
) -> None:
    empty = {topic: message().SerializeToString() for topic, message in PROTOBUF.items()}
    texts = dict.fromkeys(RECORDS, b'{"now_s": 1.5}')

    record([made_up.item([Message(topic, 1.5, data) for topic, data in (empty | texts).items()])])

    with directory.recording.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        decoded = reader.iter_decoded_messages(topics=[topic.value for topic in PROTOBUF])
        kinds = {channel.topic: type(message).__name__ for _, channel, _, message in decoded}
        encodings = {
            channel.topic: channel.message_encoding for channel in reader.get_summary().channels.values()
        }
    assert kinds == {topic.value: message.DESCRIPTOR.name for topic, message in PROTOBUF.items()}
    assert encodings.keys() == {topic.value for topic in Topic}
    assert all(encodings[topic.value] == "json" for topic in RECORDS)
