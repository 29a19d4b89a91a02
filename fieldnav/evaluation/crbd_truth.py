"""The files of the Crop Row Benchmark Dataset: pictures, their true rows, the authors' own detections."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fieldnav.errors import SettingsError
from fieldnav.evaluation.photographs import PhotographSet, read_words
from fieldnav.messages import Floats

WIDTH_PX, HEIGHT_PX = 320, 240
"""Of every picture of the set."""

CENTRE_PX = WIDTH_PX / 2
"""The column that a row's offset c counts from."""

PICTURES, TRUTH, AUTHORS = "images", PhotographSet.CRBD.truth, "tmgem"
"""Folders of the set."""

PICTURE_SUFFIXES = (".jpg", ".JPG", ".jpeg", ".png")
"""That a picture may have; the first is what the set itself has."""

OFFSET, SPACING = 0, 1
"""Columns of a .crp file."""

TRUTH_COLUMNS, AUTHORS_ROWS = 2, 3

LEAST_SPACING_PX, LARGEST_OFFSET_PX = 1.0, 10.0 * WIDTH_PX
"""Beyond these a picture would have thousands of true rows, or none; the set's own keep far within."""


@dataclass(frozen=True, slots=True)
class TrueLattice:
    """The true rows of one picture: at image row v, row k lies at offset[v] + k spacing[v] + CENTRE_PX.

    offset_px and spacing_px: shape (height,), NaN above the first image row that is annotated.
    """

    offset_px: Floats
    spacing_px: Floats

    def rows(self, index: NDArray[np.int64]) -> Floats:
        """The columns of the rows `index`, NaN where they lie outside the picture; shape (*index, height)."""
        place = self.offset_px + index[..., None] * self.spacing_px + CENTRE_PX
        return np.where((place >= 0) & (place < WIDTH_PX), place, np.nan)

    def visible(self) -> NDArray[np.int64]:
        """The indices, rising, of every row that the picture shows a part of; there may be none."""
        left = np.nanmin(np.ceil(-(self.offset_px + CENTRE_PX) / self.spacing_px))
        right = np.nanmax(np.floor((WIDTH_PX - self.offset_px - CENTRE_PX) / self.spacing_px))
        return np.arange(int(left), int(right) + 1, dtype=np.int64)


@dataclass(frozen=True, slots=True)
class Picture:
    """One picture of the set; authors_px: shape (3, height), the authors' own rows, None where absent."""

    path: Path
    truth: TrueLattice
    authors_px: Floats | None


def pictures_in(folder: Path) -> list[Picture]:
    """Every picture that has ground truth, by name. Raises SettingsError."""
    truths = sorted((folder / TRUTH).glob("*.crp"))
    if not truths:
        raise SettingsError(f"{folder / TRUTH}: holds no ground truth; allowed is one .crp file a picture")
    return [_picture(folder, path) for path in truths]


def _picture(folder: Path, path: Path) -> Picture:
    authors = folder / AUTHORS / f"{path.stem}.tmg"
    rows = _numbers(authors, AUTHORS_ROWS).T if authors.exists() else None
    if rows is not None and rows.shape[1] != HEIGHT_PX:
        raise SettingsError(f"{authors}: has {rows.shape[1]} lines; allowed is {HEIGHT_PX}")
    pictures = [folder / PICTURES / f"{path.stem}{suffix}" for suffix in PICTURE_SUFFIXES]
    picture = next((each for each in pictures if each.exists()), pictures[0])
    return Picture(picture, read_truth(path), rows)


def read_truth(path: Path) -> TrueLattice:
    """The true rows in a .crp file, whose last line is the lowest image row. Raises SettingsError."""
    numbers = _numbers(path, TRUTH_COLUMNS)
    if not 0 < len(numbers) <= HEIGHT_PX:
        raise SettingsError(f"{path}: has {len(numbers)} lines; allowed is 1 to {HEIGHT_PX}")
    spacing, offset = numbers[:, SPACING], numbers[:, OFFSET]
    if (least := spacing.min()) < LEAST_SPACING_PX:
        raise SettingsError(f"{path}: d: {least:g}: allowed is {LEAST_SPACING_PX:g} px or more")
    if (furthest := np.abs(offset).max()) > LARGEST_OFFSET_PX:
        raise SettingsError(f"{path}: c: {furthest:g}: allowed is {LARGEST_OFFSET_PX:g} px or less")
    whole = np.full((HEIGHT_PX, TRUTH_COLUMNS), np.nan)
    whole[HEIGHT_PX - len(numbers) :] = numbers
    return TrueLattice(whole[:, OFFSET], whole[:, SPACING])


def _numbers(path: Path, columns: int) -> Floats:
    """The numbers of a file, shape (lines, columns). Raises SettingsError."""
    lines = [line.split() for line in read_words(path).splitlines() if line.strip()]
    try:
        numbers = np.array([[float(word) for word in line] for line in lines]).reshape(-1, columns)
    except ValueError as error:
        raise SettingsError(f"{path}: is no table; allowed is {columns} numbers a line") from error
    if len(numbers) != len(lines) or not np.isfinite(numbers).all():
        raise SettingsError(f"{path}: is no table; allowed is {columns} finite numbers a line")
    return numbers
