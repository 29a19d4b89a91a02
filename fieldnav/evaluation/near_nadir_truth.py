"""The true rows of the photographs near the robot's own view, as rows.json holds them."""

import json
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, FiniteFloat, ValidationError

from fieldnav.errors import SettingsError
from fieldnav.evaluation.photographs import read_words
from fieldnav.messages import RowLine
from fieldnav.settings.problems import describe

TRUTH = "rows.json"
ABOUT = "_meta"
"""The entry of rows.json that is no photograph."""


class Flag(Enum):
    """How much of a row a photograph shows; only a full one must be found."""

    FULL = "f"
    PARTLY = "p"
    WEAK = "w"


class PhotographedCrop(Enum):
    """What grows in a photograph."""

    MAIZE = "maize"
    EARLY_MAIZE = "maize (early)"
    SOYBEAN = "soybean"
    WINTER_WHEAT = "winter wheat"


class _Row(BaseModel):
    model_config = ConfigDict(frozen=True)
    x_top: FiniteFloat
    x_bottom: FiniteFloat
    flag: Flag


class _Entry(BaseModel):
    model_config = ConfigDict(frozen=True)
    crop: PhotographedCrop
    rows: tuple[_Row, ...]


@dataclass(frozen=True, slots=True)
class Photograph:
    """One photograph: its file, its crop, its true rows, and which of them must be found."""

    path: Path
    crop: PhotographedCrop
    rows: tuple[RowLine, ...]
    must_be_found: tuple[bool, ...]


def photographs_in(folder: Path) -> list[Photograph]:
    """Every photograph that rows.json names, in its order. Raises SettingsError."""
    path = folder / TRUTH
    entries = _document(path)
    return [
        _photograph(folder / "images" / name, _checked(entry, f"{path}: {name}"))
        for name, entry in entries.items()
        if name != ABOUT
    ]


def _document(path: Path) -> dict[str, Any]:
    try:
        document = json.loads(read_words(path))
    except ValueError as error:
        raise SettingsError(f"{path}: is no JSON: {error}") from error
    if not isinstance(document, dict):
        raise SettingsError(f"{path}: is no JSON object; allowed is one key a photograph")
    return document


def _checked(entry: object, label: str) -> _Entry:
    try:
        return _Entry.model_validate(entry)
    except ValidationError as error:
        raise SettingsError(f"{label}: {describe(error, _Entry)[0]}") from error


def _photograph(path: Path, entry: _Entry) -> Photograph:
    rows = tuple(RowLine(row.x_top, row.x_bottom) for row in entry.rows)
    return Photograph(path, entry.crop, rows, tuple(row.flag is Flag.FULL for row in entry.rows))
