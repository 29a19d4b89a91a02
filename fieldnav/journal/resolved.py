"""settings.yaml: everything in force during a run, resolved, with the application's version."""

from collections.abc import Hashable, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fieldnav import __version__
from fieldnav.errors import SettingsError
from fieldnav.journal.directory import next_number
from fieldnav.journal.files import alone_in, write_atomically
from fieldnav.messages import CameraName
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.documents import parse_mapping, read_text, written
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import checked
from fieldnav.settings.robot import Robot

HEADER = (
    "# Everything that was in force in this run, defaults included. A record: changing it changes nothing.\n"
)
DRIVEN_UTC = "driven_utc"
"""The option of a simulated run that has the real time at which it was driven; its journal has none."""

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
    """Write the whole file or nothing, with the run's number; `field` in simulation only.

    Raises OutputError.
    """
    parts = {"crop": crop, "robot": robot, "field": field}
    given = {name: part.model_dump(mode="json") for name, part in parts.items() if part is not None}
    runs = path.parent.parent
    with ExitStack() as stack:
        with suppress(OSError):  # a disk that knows no locks: two runs at once may have the same number
            stack.enter_context(alone_in(runs))
        document = {"fieldnav": __version__, "run": next_number(runs), "options": dict(options or {})}
        write_atomically(path, f"{HEADER}{written(document | given)}".encode())


def read_settings(path: Path) -> Settings:
    """The settings that a run's directory keeps. Raises SettingsError."""
    label = str(path)
    document = parse_mapping(read_text(label), label)
    crop = checked(CropProfile, _part(document, "crop", label), f"{label}: crop")
    robot = checked(Robot, _part(document, "robot", label), f"{label}: robot")
    return Settings(crop, robot, dict(_part(document, "options", label)))


def skies_px(path: Path) -> Mapping[CameraName, float]:
    """How many image rows of each camera of a run look above the horizon; {} where nothing says so."""
    try:
        return read_settings(path).robot.cameras.skies_px()
    except SettingsError:
        return {}


def _part(document: Mapping[Hashable, Any], name: str, label: str) -> Mapping[Any, Any]:
    part = document.get(name)
    if not isinstance(part, Mapping):
        raise SettingsError(f"{label}: {name}: is not there; allowed is the settings.yaml of a run")
    return part
