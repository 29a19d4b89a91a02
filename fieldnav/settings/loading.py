"""From a name or a path to checked settings; every error is one line: file, key, value, what is allowed.

A name stands for a file shipped with fieldnav. Whatever holds a path separator or ends in .yaml or .yml is a
file of the user's own.
"""

import json
import os
from collections.abc import Hashable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from fieldnav.errors import SettingsError
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.documents import parse_mapping, read_text
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.fit import check_fit, check_size
from fieldnav.settings.kinds import Kind, is_path, names_of
from fieldnav.settings.model import Settings
from fieldnav.settings.one_line import one_line
from fieldnav.settings.problems import MAX_REPORTED, MOST_DESCRIBED, describe, nearest, shortened
from fieldnav.settings.robot import Robot

__all__ = [
    "Kind",
    "check_fit",
    "check_size",
    "load",
    "load_crop",
    "load_field",
    "load_robot",
    "names_of",
    "revised",
]

Model = TypeVar("Model", bound=Settings)


def load_crop(name_or_path: str | Path) -> CropProfile:
    """A crop profile. Raises SettingsError."""
    return _load(Kind.CROP, CropProfile, name_or_path)


def load_robot(name_or_path: str | Path) -> Robot:
    """A robot. Raises SettingsError."""
    return _load(Kind.ROBOT, Robot, name_or_path)


def load_field(name_or_path: str | Path) -> FieldSettings:
    """A simulated field, whose crop is known; a path of a crop counts from the field's file.

    Raises SettingsError.
    """
    field = _load(Kind.FIELD, FieldSettings, name_or_path)
    if is_path(name_or_path) and is_path(field.crop):
        folder = os.path.dirname(name_or_path) or "."
        beside = os.path.join(folder, str(field.crop).removeprefix("./"))
        field = field.model_copy(update={"crop": beside})
    try:
        load_crop(field.crop)
    except SettingsError as error:
        raise SettingsError(f"{_label(Kind.FIELD, name_or_path)}: crop: {error}") from error
    return field


def load(kind: Kind, name_or_path: str | Path) -> CropProfile | Robot | FieldSettings:
    """Settings of any kind. Raises SettingsError."""
    match kind:
        case Kind.CROP:
            return load_crop(name_or_path)
        case Kind.ROBOT:
            return load_robot(name_or_path)
        case Kind.FIELD:
            return load_field(name_or_path)


def parse(model: type[Model], text: str, label: str) -> Model:
    """Settings from the text of a file that messages call `label`. Raises SettingsError."""
    return checked(model, parse_mapping(text, label), label)


def checked(
    model: type[Model], document: Mapping[Any, Any], label: str, called: Mapping[str, str] | None = None
) -> Model:
    """Settings of a document that was read from `label`; `called`: see `revised`. Raises SettingsError."""
    try:
        # Strict JSON rules refuse "yes" for a number and 2.5 for a count, but take enums and lists.
        return model.model_validate_json(json.dumps(_plain(document)), strict=True)
    except ValidationError as error:
        lines = describe(error, model, called or {})
        count = "" if error.error_count() > MOST_DESCRIBED else f" {len(lines) - MAX_REPORTED}"
        rest = f"; and{count} more" if len(lines) > MAX_REPORTED else ""
        said = "; ".join(lines[:MAX_REPORTED]) + rest
        raise SettingsError(f"{label}: {said}" if label else said) from error


def revised(
    settings: Model,
    changes: Mapping[str, Any],
    label: str = "options",
    called: Mapping[str, str] | None = None,
) -> Model:
    """The same settings with some top-level values changed, checked like a file. Raises SettingsError.

    `called` has the name that a key goes by where the change came from, say an option's.
    """
    document = settings.model_dump(mode="json") | dict(changes)
    return checked(type(settings), document, label, called)


def _load(kind: Kind, model: type[Model], name_or_path: str | Path) -> Model:
    label = _label(kind, name_or_path)
    if is_path(name_or_path):
        return parse(model, read_text(label), label)
    name = str(name_or_path)
    known = names_of(kind)
    if name not in known:
        raise SettingsError(
            f"unknown {kind.singular} '{shortened(one_line(name))}': {nearest(name, known)}; "
            "a file of your own ends in .yaml"
        )
    resource = files("config") / kind.value / f"{name}.yaml"
    return parse(model, resource.read_text(encoding="utf-8"), label)


def _label(kind: Kind, name_or_path: str | Path) -> str:
    return str(name_or_path) if is_path(name_or_path) else f"config/{kind.value}/{name_or_path}.yaml"


def _plain(value: Any) -> Any:
    """The same document in JSON's types; dates and the like become the text they were written as."""
    if isinstance(value, Mapping):
        return {_key(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple | set):
        return [_plain(entry) for entry in value]
    return value if value is None or isinstance(value, bool | int | float | str) else str(value)


def _key(key: Hashable) -> str:
    return key if isinstance(key, str) else str(key)
