"""Rows found in the Crop Row Benchmark Dataset, scored as its authors score; their detections beside ours.

Neither the camera nor the crop is told to the finder. Only rows of at least LEAST_CONFIDENCE count.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fieldnav.evaluation.benchmark import Figure, Progress, one_by_one
from fieldnav.evaluation.crbd_score import LOWER_HALF_PX, crda, positions, true_rows
from fieldnav.evaluation.crbd_truth import HEIGHT_PX, WIDTH_PX, Picture, pictures_in
from fieldnav.evaluation.found_rows import UNMATCHED, Finder
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.reliability import JudgedRows
from fieldnav.messages import Floats

PART = PhotographSet.CRBD.title
QUICK_STEP = 4
"""A quick run takes one picture in so many."""


@dataclass(frozen=True, slots=True)
class _Region:
    """A part of the picture that is scored: from which image row down, the goal, the authors' own score."""

    metric: str
    first_row: int
    goal: float
    published: float


REGIONS = (
    _Region("CRDA, lower half", LOWER_HALF_PX, goal=0.92, published=0.821),
    _Region("CRDA, whole image", 0, goal=0.82, published=0.746),
)
PUBLISHED = "template matching, published, all 281 images"
CHECK = "the set's authors' detections"
SAME_IMAGES = "template matching, same images, scored in this run"


@dataclass(frozen=True, slots=True)
class _Scored:
    """One picture's scores, a region each, of fieldnav's rows and of the authors'; all rows judged."""

    ours: tuple[float, ...]
    authors: tuple[float, ...] | None
    judged: JudgedRows


def crbd(folder: Path, find: Finder, progress: Progress, quick: bool) -> tuple[list[Figure], JudgedRows]:
    """The figures of this set, and every row found with whether it is right. Raises SettingsError."""
    pictures = pictures_in(folder)[:: QUICK_STEP if quick else 1]
    scored = [_scored(picture, find) for picture in one_by_one(PART, pictures, progress)]
    return _figures(scored), JudgedRows.joined(each.judged for each in scored)


def _scored(picture: Picture, find: Finder) -> _Scored:
    found = find(read_photograph(picture.path, (WIDTH_PX, HEIGHT_PX)), None)
    authors = None if picture.authors_px is None else _scores(picture.authors_px, picture)
    right = true_rows(positions(found.paths_px), picture.truth) != UNMATCHED
    return _Scored(
        _scores(positions(found.sure().paths_px), picture), authors, JudgedRows(found.confidence, right)
    )


def _scores(found_px: Floats, picture: Picture) -> tuple[float, ...]:
    return tuple(crda(found_px, picture.truth, region.first_row) for region in REGIONS)


def _figures(scored: Sequence[_Scored]) -> list[Figure]:
    """The figures of each region, beside the authors' on the same images where those are there."""
    ours = np.array([each.ours for each in scored])
    authors = np.array([each.authors for each in scored if each.authors is not None])
    case = f"{PART}, {len(scored)} images"
    if len(authors) < len(ours):
        return [
            _figure(case, *each, each[0].published, PUBLISHED) for each in zip(REGIONS, ours.T, strict=True)
        ]
    figures = [
        _figure(case, region, mine, float(theirs.mean()), SAME_IMAGES)
        for region, mine, theirs in zip(REGIONS, ours.T, authors.T, strict=True)
    ]
    return figures + [_check(region, theirs) for region, theirs in zip(REGIONS, authors.T, strict=True)]


def _figure(case: str, region: _Region, scores: Floats, known: float, source: str) -> Figure:
    return Figure(case, region.metric, float(scores.mean()), float(scores.std()), region.goal, known, source)


def _check(region: _Region, scores: Floats) -> Figure:
    """The authors' own detections by the same code: near what is published, the scorer is right."""
    mean, std = float(scores.mean()), float(scores.std())
    return Figure(CHECK, region.metric, mean, std, best_known=region.published, source=PUBLISHED)
