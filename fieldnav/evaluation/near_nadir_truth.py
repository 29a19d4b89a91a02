"""The true rows of the photographs near the robot's own view, as rows.json holds them."""

from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from fieldnav.errors import SettingsError
from fieldnav.evaluation.photographs import Column, PhotographSet
from fieldnav.evaluation.truth_file import checked, read_json
from fieldnav.messages import RowLine

TRUTH = PhotographSet.NEAR_NADIR.truth
ABOUT = "_meta"
"""The entry of rows.json that is no photograph."""


class Flag(Enum):
    """How much of a row a photograph shows; only a full one must be found."""

    FULL = "f"
    PARTLY = "p"
    WEAK = "w"


class _Row(BaseModel):
    model_config = ConfigDict(frozen=True)
    x_top: Column
    x_bottom: Column
    flag: Flag


class _Entry(BaseModel):
    model_config = ConfigDict(frozen=True)
    crop: str = Field(min_length=1)
    rows: tuple[_Row, ...]


@dataclass(frozen=True, slots=True)
class Photograph:
    """One photograph: its file, its crop in words, its true rows, and which of them must be found."""

    path: Path
    crop: str
    rows: tuple[RowLine, ...]
    must_be_found: tuple[bool, ...]


def photographs_in(folder: Path) -> list[Photograph]:
    """Every photograph that rows.json names, in its order. Raises SettingsError."""
    path = folder / TRUTH
    entries = _document(path)
    return [
        _photograph(folder / "images" / name, checked(entry, _Entry, f"{path}: {name}"))
        for name, entry in entries.items()
        if name != ABOUT
    ]


def _document(path: Path) -> dict[str, Any]:
    document = read_json(path)
    if not isinstance(document, dict):
        raise SettingsError(f"{path}: is no JSON object; allowed is one key a photograph")
    if not document.keys() - {ABOUT}:
        raise SettingsError(f"{path}: names no photograph; allowed is one key a photograph")
    return document


def _photograph(path: Path, entry: _Entry) -> Photograph:
    rows = tuple(RowLine(row.x_top, row.x_bottom) for row in entry.rows)
    return Photograph(path, entry.crop, rows, tuple(row.flag is Flag.FULL for row in entry.rows))
