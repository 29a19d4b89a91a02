"""One quantity over time, drawn with braille dots, or with plain characters where there are no others."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.words import figure, measured
from fieldnav.messages import Floats

LABEL = 8
"""Characters of the scale at the left."""
ROWS, PLAIN_ROWS = 3, 5
DOTS_ACROSS, DOTS_DOWN = 2, 4
"""Dots of a braille character."""
BRAILLE = 0x2800
DOT = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
"""The bit of each dot of a braille character in Unicode, by row and column."""
VALUE, THRESHOLD = 1, 2
JOINED_S = 0.5
"""Values no further apart are one line: what was judged in between is what was judged before. Our choice."""
DASH = 4
"""Dots from one dash of the threshold's line to the next."""

Grid = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Course:
    """A quantity over time, shape (n,) each; the threshold that it was held against, if any."""

    name: str
    at_s: Floats
    value: Floats
    threshold: float | None = None
    unit: str = ""


def chart(course: Course, span_s: tuple[float, float], width: int, plain: bool) -> list[str]:
    """Lines of text, each at most `width` characters; the first names the quantity and its range."""
    low, high = _range(course)
    if low == high:
        return [f"{_title(course)}, all the time"]
    rows, across, down = (PLAIN_ROWS, 1, 1) if plain else (ROWS, DOTS_ACROSS, DOTS_DOWN)
    columns = max(1, width - LABEL - 2)
    grid = _grid(course, span_s, (low, high), (rows * down, columns * across))
    drawn = _plain(grid) if plain else _braille(grid)
    labels = [figure(high), *[""] * (rows - 2), figure(low)]
    edge = "|" if plain else "│"
    lines = [f"{label:>{LABEL}} {edge}{line}".rstrip() for label, line in zip(labels, drawn, strict=True)]
    first, last = clock(span_s[0]), clock(span_s[1])
    scale = f"{first:<{max(1, columns - len(last))}}{last}"
    return [_title(course), *lines, f"{'':>{LABEL}}  {scale}"]


def _title(course: Course) -> str:
    newest = f"{course.name}: {measured(float(course.value[-1]), course.unit)}"
    return newest + (
        "" if course.threshold is None else f", threshold {measured(course.threshold, course.unit)}"
    )


def _range(course: Course) -> tuple[float, float]:
    shown: Sequence[float] = [*course.value, *([] if course.threshold is None else [course.threshold])]
    return float(min(shown)), float(max(shown))


def _grid(
    course: Course, span_s: tuple[float, float], limits: tuple[float, float], size: tuple[int, int]
) -> Grid:
    """Shape (dots down, dots across): where a value stands, and where the threshold's dashes do."""
    height, width = size
    grid = np.zeros(size, np.uint8)
    (begin_s, end_s), (low, high) = span_s, limits
    level = np.rint((high - course.value) / (high - low) * (height - 1)).astype(int)
    column = np.clip((course.at_s - begin_s) / max(end_s - begin_s, 1e-9) * width, 0, width - 1).astype(int)
    if course.threshold is not None:
        grid[
            round((high - course.threshold) / (high - low) * (height - 1)), :: DASH if width > DASH else 1
        ] = THRESHOLD
    joined = np.flatnonzero((np.diff(column) > 1) & (np.diff(course.at_s) <= JOINED_S))
    for at in joined.tolist():
        grid[level[at], column[at] : column[at + 1]] = VALUE
    for at in np.unique(column).tolist():
        here = level[column == at]
        grid[here.min() : here.max() + 1, at] = VALUE
    return grid


def _braille(grid: Grid) -> list[str]:
    height, width = grid.shape
    cells = (grid > 0).reshape(height // DOTS_DOWN, DOTS_DOWN, width // DOTS_ACROSS, DOTS_ACROSS)
    codes = (cells * DOT[None, :, None, :]).sum(axis=(1, 3))
    return ["".join(chr(BRAILLE + int(code)) if code else " " for code in row) for row in codes]


def _plain(grid: Grid) -> list[str]:
    return ["".join(" *-"[mark] for mark in row) for row in grid]
