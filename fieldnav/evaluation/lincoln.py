"""Rows found in the Crop Row Detection Lincoln Dataset: sugar beet before a field robot's forward camera.

Neither the camera nor the crop is told to the finder. Only rows of at least LEAST_CONFIDENCE count; the
reliability of confidence judges all of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, field_validator

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Better, Figure, Progress, one_by_one
from fieldnav.evaluation.found_rows import UNMATCHED, Finder
from fieldnav.evaluation.lincoln_score import SIZE_PX, LincolnTally, judge, score, total
from fieldnav.evaluation.photographs import Column, PhotographSet, read_photograph
from fieldnav.evaluation.reliability import JudgedRows
from fieldnav.evaluation.truth_file import checked, read_json
from fieldnav.messages import Floats

PART = PhotographSet.LINCOLN.title
PICTURES, TRUTH = "images", PhotographSet.LINCOLN.truth
ABOUT = "_meta"
"""The entry of rows.json that is no picture."""

QUICK_STEP = 10
"""A quick run takes one picture in so many."""

ALIKE_DEG = 2.0
PERCENT = 100.0
MIN_POINTS, MIN_HEIGHT_PX = 2, 1.0
"""Of an annotated row; with less it has no direction."""

NETWORK = "a network (YOLOv5n-seg, 4 MB), 150 other pictures of the set"

ImageRow = Annotated[float, Field(ge=0.0, le=SIZE_PX)]
Curve = Annotated[tuple[tuple[Column, ImageRow], ...], Field(min_length=MIN_POINTS)]


class _Entry(BaseModel):
    """The annotated rows of one picture, from its list in rows.json."""

    model_config = ConfigDict(frozen=True)
    rows: tuple[Curve, ...]

    @field_validator("rows")
    @classmethod
    def _has_height(cls, rows: tuple[Curve, ...]) -> tuple[Curve, ...]:
        for number, row in enumerate(rows):
            heights = [y for _, y in row]
            if max(heights) - min(heights) < MIN_HEIGHT_PX:
                raise ValueError(f"row {number} spans less than {MIN_HEIGHT_PX:g} px in y")
        return rows


@dataclass(frozen=True, slots=True)
class LincolnPicture:
    """One picture of the set; rows: its annotated rows, each of shape (points, 2), x and y in pixels."""

    path: Path
    rows: tuple[Floats, ...]


def pictures_in(folder: Path) -> list[LincolnPicture]:
    """Every picture that rows.json names, in its order. Raises SettingsError."""
    path = folder / TRUTH
    return [
        _picture(folder / PICTURES / name, entry, f"{path}: {name}")
        for name, entry in _document(path).items()
        if name != ABOUT
    ]


def _document(path: Path) -> dict[str, Any]:
    document = read_json(path)
    if not isinstance(document, dict):
        raise SettingsError(f"{path}: is no JSON object; allowed is one key a picture")
    if not document.keys() - {ABOUT}:
        raise SettingsError(f"{path}: names no picture; allowed is one key a picture")
    return document


def _picture(path: Path, entry: object, label: str) -> LincolnPicture:
    rows = checked({"rows": entry}, _Entry, label).rows
    return LincolnPicture(path, tuple(np.array(row, dtype=np.float64) for row in rows))


def lincoln(folder: Path, find: Finder, progress: Progress, quick: bool) -> tuple[list[Figure], JudgedRows]:
    """The figures of this set, and every row found with whether it is right. Raises SettingsError."""
    pictures = pictures_in(folder)[:: QUICK_STEP if quick else 1]
    scored = [_scored(picture, find) for picture in one_by_one(PART, pictures, progress)]
    return _figures([tally for tally, _ in scored]), JudgedRows.joined(judged for _, judged in scored)


def _scored(picture: LincolnPicture, find: Finder) -> tuple[LincolnTally, JudgedRows]:
    found = find(read_photograph(picture.path, (SIZE_PX, SIZE_PX)), None)
    judged = judge(found.paths_px, picture.rows)
    right = judged.true[judged.counts] != UNMATCHED
    return score(found.sure().paths_px, picture.rows), JudgedRows(found.confidence[judged.counts], right)


def _figures(tallies: Sequence[LincolnTally]) -> list[Figure]:
    """The figures over all pictures; a mean of no matched row is NaN."""
    case, tally = f"{PART}, {len(tallies)} images", total(tallies)
    error, alike = tally.distance_px / SIZE_PX * PERCENT, tally.turned_deg < ALIKE_DEG
    nothing, hit = float("nan"), tally.hits > 0
    return [
        Figure(case, "F1", tally.f1, goal=0.90, best_known=0.864, source=NETWORK),
        Figure(case, "recall", tally.recall, best_known=0.83, source=NETWORK),
        Figure(case, "precision", tally.precision, goal=0.95, best_known=0.90, source=NETWORK),
        Figure(
            case,
            "matched rows within 2 degrees (%)",
            float(alike.mean()) * PERCENT if hit else nothing,
            goal=85.0,
            best_known=83.0,
            source=NETWORK,
        ),
        Figure(
            case,
            "mean position error (% of width)",
            float(error.mean()) if hit else nothing,
            float(error.std()) if hit else None,
            better=Better.LOWER,
        ),
    ]
