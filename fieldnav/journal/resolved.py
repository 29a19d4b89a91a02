"""settings.yaml: everything in force during a run, resolved, with the application's version."""

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fieldnav import __version__
from fieldnav.errors import SettingsError
from fieldnav.journal.files import write_atomically
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.documents import parse_mapping, read_text, written
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import checked
from fieldnav.settings.robot import Robot

HEADER = (
    "# Everything that was in force in this run, defaults included. A record: changing it changes nothing.\n"
)

Option = str | int | float | bool | None


@dataclass(frozen=True, slots=True)
class Settings:
    """What a run was driven with."""

    crop: CropProfile
    robot: Robot
    options: Mapping[str, Option] = field(default_factory=dict)


def write_settings(
    path: Path,
    crop: CropProfile,
    robot: Robot,
    field: FieldSettings | None = None,
    options: Mapping[str, Option] | None = None,
) -> None:
    """Write the whole file or nothing; `field` in simulation only. Raises OutputError."""
    document: dict[str, object] = {"fieldnav": __version__, "options": dict(options or {})}
    parts = {"crop": crop, "robot": robot, "field": field}
    document |= {name: part.model_dump(mode="json") for name, part in parts.items() if part is not None}
    text = HEADER + written(document)
    write_atomically(path, text.encode())


def read_settings(path: Path) -> Settings:
    """The settings that a run's directory keeps. Raises SettingsError."""
    label = str(path)
    document = parse_mapping(read_text(label), label)
    crop = checked(CropProfile, _part(document, "crop", label), f"{label}: crop")
    robot = checked(Robot, _part(document, "robot", label), f"{label}: robot")
    return Settings(crop, robot, dict(_part(document, "options", label)))


def _part(document: Mapping[Hashable, Any], name: str, label: str) -> Mapping[Any, Any]:
    part = document.get(name)
    if not isinstance(part, Mapping):
        raise SettingsError(f"{label}: {name}: is not there; allowed is the settings.yaml of a run")
    return part
