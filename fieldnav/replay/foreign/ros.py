"""The rosbags package, which only those need who replay what ROS has recorded."""

from dataclasses import dataclass
from types import ModuleType
from typing import Any

from fieldnav.errors import SettingsError
from fieldnav.replay.foreign.container import Decoder

IDL_BETWEEN, IDL_HEAD = "=" * 80 + "\n", "IDL: "
"""How a definition of several IDL files is put together."""
ANY_CHECKSUM = "*"
"""Of a publisher in ROS 1 that does not say which version of a type it has."""


@dataclass(frozen=True, slots=True)
class Rosbags:
    """The parts of the package that are used."""

    bag1: ModuleType
    bag2: ModuleType
    types: ModuleType


@dataclass(frozen=True, slots=True)
class Definition:
    """A type as a file defines it; checksum: of the type, where the file has one."""

    type: str
    text: str
    idl: bool
    ros1: bool
    checksum: str = ""


def rosbags(name: str) -> Rosbags:
    """The package. Raises SettingsError where it is not installed; name: of what needs it."""
    try:
        from rosbags import rosbag1, rosbag2, typesys  # noqa: PLC0415 - an extra, that not everybody installs
    except ImportError as error:
        raise SettingsError(
            f"{name}: holds messages of ROS, which the package rosbags reads; it is not installed: "
            "pip install 'fieldnav[bags]'"
        ) from error
    return Rosbags(rosbag1, rosbag2, typesys)


def decoder(name: str, definition: Definition) -> Decoder:
    """What makes messages of one topic of bytes; nothing else in the file need be readable.

    A definition that lacks or cannot be read, or another than the checksum's, gives way to ROS's own of that
    type. Raises SettingsError, and what rosbags raises where ROS has none.
    """
    types = rosbags(name).types
    store = _own(types, definition)
    if store is None:
        version = types.Stores.ROS1_NOETIC if definition.ros1 else types.Stores.LATEST
        store = types.get_typestore(version)
        if not _fits(store, definition):
            raise SettingsError(
                f"{name}: the definition of {definition.type} cannot be read, and its checksum "
                "is not that of ROS's own"
            )
    read = store.deserialize_ros1 if definition.ros1 else store.deserialize_cdr
    return lambda data: read(data, definition.type)


def _own(types: ModuleType, definition: Definition) -> Any | None:
    """The types as the file defines them; None where that cannot be read or is not what the checksum says."""
    store = types.get_typestore(types.Stores.EMPTY)
    try:
        if definition.idl:
            for part in definition.text.split(IDL_BETWEEN):
                store.register(types.get_types_from_idl(_without_head(part)))
        else:
            store.register(types.get_types_from_msg(definition.text, definition.type))
        return store if _fits(store, definition) else None
    except Exception:  # of many kinds, for what is broken here and there
        return None


def _without_head(part: str) -> str:
    return part.partition("\n")[2] if part.startswith(IDL_HEAD) else part


def _fits(store: Any, definition: Definition) -> bool:
    """Whether a type, and all that it is made of, is known and has the checksum. Raises what rosbags does."""
    kind = definition.type
    found = store.generate_msgdef(kind)[1] if definition.ros1 else store.hash_rihs01(kind)
    return definition.checksum in ("", ANY_CHECKSUM, found)
