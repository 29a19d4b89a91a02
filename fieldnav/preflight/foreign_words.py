"""What another host's telegram commands, in words."""

from collections.abc import Mapping
from contextlib import suppress
from enum import IntEnum

from drivers.thorvald_protocol import Kind, Mode, NmtCommand
from drivers.wire_layout import Telegram

ALL_NODES = 0
"""Node number of an NMT command that every node obeys (CiA 301)."""

_SAYINGS: Mapping[Kind, str] = {
    Kind.DRIVE: "drives node {node} at {DriveSpeed} per mille",
    Kind.STEER: "steers node {node} to {SteeringAngle} per mille",
    Kind.MODE: "sets node {node} to mode {mode}",
    Kind.SET_UP: "sets parameter {Parameter} of node {node} to {Value}",
    Kind.NMT: "commands {command} to {nodes}",
    Kind.SDO_REQUEST: "asks for object {Index:04X} of node {node}",
    Kind.HOST_HEARTBEAT: "is another host's heartbeat",
}


def meaning(telegram: Telegram) -> str:
    """What a host's telegram says; of one without values only what it was to be."""
    if not telegram.values:
        return f"to node {telegram.node} cannot be read: {telegram.kind.value}"
    values = {name: int(value) for name, value in telegram.values.items()}
    nodes = values.get("Node", telegram.node)
    words = {
        "node": telegram.node,
        "nodes": "all nodes" if nodes == ALL_NODES else f"node {nodes}",
        "mode": _named(Mode, values.get("Mode", 0)),
        "command": _named(NmtCommand, values.get("Command", 0)),
    }
    return _SAYINGS[telegram.kind].format(**values, **words)


def _named(words: type[IntEnum], number: int) -> str:
    """The number's word; itself where it has none."""
    with suppress(ValueError):
        return words(number).name.lower().replace("_", " ")
    return str(number)
