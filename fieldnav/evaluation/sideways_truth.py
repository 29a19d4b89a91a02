"""Photographs of a camera that moves sideways over rows, and which of them it truly crosses, from gt.json."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from fieldnav.evaluation.photographs import Column, read_photograph
from fieldnav.evaluation.truth_file import checked, read_json
from fieldnav.messages import Floats, Image, Side
from fieldnav.perception.counting.row_count import RowCount, passages_of

TRUTH = "gt.json"


class Mode(Enum):
    """The way that the camera moves."""

    LATERAL = "lateral"
    FORWARD = "forward"


class _Row(BaseModel):
    model_config = ConfigDict(frozen=True)
    id: int
    x_top: Column
    x_bottom: Column


class _Frame(BaseModel):
    model_config = ConfigDict(frozen=True)
    file: str = Field(min_length=1)
    rows: tuple[_Row, ...]


class _Sequence(BaseModel):
    model_config = ConfigDict(frozen=True)
    size: tuple[int, int]
    mode: Mode
    frames: tuple[_Frame, ...] = Field(min_length=1)


@dataclass(frozen=True, slots=True)
class SidewaysSequence:
    """The pictures, of one size, and where each row passes mid-height in each of them.

    beside: shape (rows, frames), pixels right of the centre column, NaN in frames that a row is not in.
    """

    name: str
    paths: tuple[Path, ...]
    size_px: tuple[int, int]
    beside: Floats

    def images(self) -> list[Image]:
        """Every picture. Raises SettingsError, also for one of another size than the truth is of."""
        return [read_photograph(path, self.size_px) for path in self.paths]


def sequences_in(folder: Path) -> list[SidewaysSequence]:
    """The sequences taken sideways among the folders of a folder, by name. Raises SettingsError."""
    read = [
        (path.parent, checked(read_json(path), _Sequence, str(path)))
        for path in sorted(folder.glob(f"*/{TRUTH}"))
    ]
    return [_sequence(parent, document) for parent, document in read if document.mode is Mode.LATERAL]


def true_count(beside: Floats, frames: Sequence[int], direction: Side) -> RowCount:
    """What is to be counted when frames, by their numbers, are shown one after the other."""
    shown = beside[:, np.asarray(frames, np.int64)]
    passages = []
    for row, places in enumerate(shown):
        there = np.flatnonzero(~np.isnan(places))
        for passage in passages_of(places[there], row, 0.0):
            passages.append(replace(passage, frame=int(there[passage.frame])))
    return RowCount(tuple(sorted(passages, key=lambda passage: passage.frame)), direction)


def _sequence(folder: Path, document: _Sequence) -> SidewaysSequence:
    numbers = sorted({row.id for frame in document.frames for row in frame.rows})
    beside = np.full((len(numbers), len(document.frames)), np.nan)
    for at, frame in enumerate(document.frames):
        for row in frame.rows:
            beside[numbers.index(row.id), at] = (row.x_top + row.x_bottom) / 2 - (document.size[0] - 1) / 2
    paths = tuple(folder / frame.file for frame in document.frames)
    return SidewaysSequence(folder.name, paths, document.size, beside)
