"""The kinds of settings file, the names that come with fieldnav, and telling a name from a path."""

from collections.abc import Mapping
from enum import Enum
from importlib.resources import files
from pathlib import Path
from typing import Any

from fieldnav.errors import SettingsError
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.problems import nearest
from fieldnav.settings.robot import Robot


class Kind(Enum):
    """The kinds of settings file; the value is the folder below `config`."""

    CROP = "crops"
    ROBOT = "robots"
    FIELD = "fields"

    @property
    def singular(self) -> str:
        return self.value.removesuffix("s")

    @property
    def model(self) -> type[CropProfile | Robot | FieldSettings]:
        return _MODELS[self]


_MODELS: dict[Kind, type[CropProfile | Robot | FieldSettings]] = {
    Kind.CROP: CropProfile,
    Kind.ROBOT: Robot,
    Kind.FIELD: FieldSettings,
}


def names_of(kind: Kind) -> list[str]:
    """The names of the shipped files of a kind, sorted."""
    folder = files("config") / kind.value
    return sorted(
        entry.name.removesuffix(".yaml") for entry in folder.iterdir() if entry.name.endswith(".yaml")
    )


def kinds_named(name: str) -> list[Kind]:
    """The kinds that have a shipped file of this name. Raises SettingsError when none has."""
    kinds = [kind for kind in Kind if name in names_of(kind)]
    if not kinds:
        known = list(dict.fromkeys(each for kind in Kind for each in names_of(kind)))
        raise SettingsError(f"unknown crop, robot or field '{name}': {nearest(name, known)}")
    return kinds


def kind_of_document(document: Mapping[Any, Any]) -> Kind:
    """The kind that most of a file's keys belong to."""
    return max(Kind, key=lambda kind: len(kind.model.model_fields.keys() & document.keys()))


def is_path(name_or_path: str | Path) -> bool:
    """Whether this is a file of the user's own rather than the name of a shipped one."""
    text = str(name_or_path)
    return isinstance(name_or_path, Path) or "/" in text or "\\" in text or text.endswith((".yaml", ".yml"))
