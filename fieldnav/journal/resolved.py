"""settings.yaml: everything in force during a run, resolved, with the application's version."""

from collections.abc import Mapping
from pathlib import Path

import yaml

from fieldnav import __version__
from fieldnav.journal.files import write_atomically
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot

HEADER = (
    "# Everything that was in force in this run, defaults included. A record: changing it changes nothing.\n"
)

Option = str | int | float | bool | None


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
    text = HEADER + yaml.safe_dump(document, sort_keys=False, allow_unicode=True, width=110)
    write_atomically(path, text.encode())
