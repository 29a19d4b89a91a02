"""Telegrams to CAN frames and back, as config/thorvald.dbc lays them out."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import can
import cantools
from cantools.database.can import Database, Message

from drivers.thorvald_protocol import Kind
from fieldnav.errors import SettingsError
from fieldnav.settings.robot import Robot

NO_NODE = 0
"""Node of the telegrams that belong to no module."""


@dataclass(frozen=True, slots=True)
class Telegram:
    """One frame's meaning: who it is from or for, its role, its signals in the DBC file's units."""

    node: int
    kind: Kind
    values: Mapping[str, float]


class DataFrame(can.Message):
    """A frame of data that the virtual bus copies quickly: it deep-copies each frame for each receiver."""

    __slots__ = ()

    def __deepcopy__(self, memo: dict[int, object] | None) -> can.Message:
        return can.Message(
            timestamp=self.timestamp,
            arbitration_id=self.arbitration_id,
            is_extended_id=self.is_extended_id,
            channel=self.channel,
            data=bytes(self.data),
        )


class WireLayout:
    """The shipped DBC file, indexed for speed."""

    def __init__(self, database: Database) -> None:
        self._by_frame_id: dict[int, tuple[int, Kind, Message]] = {}
        self._by_role: dict[tuple[int, Kind], Message] = {}
        for message in database.messages:
            node, kind = _role(message.name)
            self._by_frame_id[message.frame_id] = (node, kind, message)
            self._by_role[node, kind] = message

    @property
    def nodes(self) -> frozenset[int]:
        """The node ids that the file describes."""
        return frozenset(node for node, _ in self._by_role if node != NO_NODE)

    def frame(self, stamp_s: float, node: int, kind: Kind, values: Mapping[str, float]) -> can.Message:
        """A frame that says this; bytes without a signal are zero. Raises KeyError for an unknown node."""
        message = self._by_role[node, kind]
        return DataFrame(
            timestamp=stamp_s,
            arbitration_id=message.frame_id,
            is_extended_id=False,
            data=message.encode(dict(values), strict=False),
            is_rx=False,
        )

    def read(self, frame: can.Message) -> Telegram | None:
        """What a frame says; None for one that is not of this layout: wrong id, length, part or type."""
        telegram = self.heard(frame)
        return telegram if telegram and telegram.values else None

    def heard(self, frame: can.Message) -> Telegram | None:
        """The same, but without values where the id is known and the rest cannot be read."""
        if frame.is_extended_id or frame.is_remote_frame or frame.is_error_frame:
            return None
        found = self._by_frame_id.get(frame.arbitration_id)
        if found is None:
            return None
        if len(frame.data) != found[2].length:
            return Telegram(found[0], found[1], {})
        try:
            values = found[2].decode(bytes(frame.data), decode_choices=False)
        except cantools.database.DecodeError:  # a multiplexer value that the layout does not have
            return Telegram(found[0], found[1], {})
        return Telegram(found[0], found[1], values)  # type: ignore[arg-type]  # without choices: all numbers


@cache
def wire_layout() -> WireLayout:
    """The layout from the shipped file; loaded once."""
    text = files("config").joinpath("thorvald.dbc").read_text(encoding="ascii")
    return WireLayout(cantools.database.load_string(text, "dbc"))  # type: ignore[arg-type]


def check_nodes(robot: Robot) -> None:
    """Raise SettingsError for a wheel module whose node id the shipped layout lacks; touches no bus."""
    nodes = wire_layout().nodes
    for wheel, module in robot.modules.items():
        if module.node_id not in nodes:
            raise SettingsError(
                f"robot {robot.name}: modules.{wheel.value}.node_id: {module.node_id}; "
                f"allowed is one of {', '.join(map(str, sorted(nodes)))}, the nodes of thorvald.dbc"
            )


def _role(name: str) -> tuple[int, Kind]:
    found = re.fullmatch(r"Module(\d+)_(.+)", name)
    return (int(found[1]), Kind(found[2])) if found else (NO_NODE, Kind(name))
