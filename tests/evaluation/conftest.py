"""Tiny sets of photographs in the formats of the real ones, and finders that report what they are told."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.evaluation.found_rows import Finder, FoundRows
from fieldnav.messages import Image, RowLine
from fieldnav.settings.crop import CropProfile

WIDTH, HEIGHT = 320, 240
ROWS = ((100.0, 60.0, "f"), (160.0, 160.0, "f"), (220.0, 260.0, "f"))
"""x at the top, x at the bottom, flag."""


def write_picture(path: Path, size: tuple[int, int] = (WIDTH, HEIGHT)) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), np.full((size[1], size[0], 3), 90, np.uint8))


def near_nadir_set(data: Path, crops: Sequence[str] = ("maize",), rows: Sequence[tuple] = ROWS) -> Path:
    """One photograph a crop, each with the same rows; returns the set's folder."""
    folder, entries = data / "near_nadir_jw", {"_meta": {"size": [WIDTH, HEIGHT]}}
    for number, crop in enumerate(crops):
        lines = [dict(zip(("x_top", "x_bottom", "flag"), row, strict=True)) for row in rows]
        entries[f"{number}.jpg"] = {"crop": crop, "source_file": "none", "rows": lines}
        write_picture(folder / "images" / f"{number}.jpg")
    (folder / "rows.json").write_text(json.dumps(entries), encoding="utf-8")
    return folder


def crbd_set(data: Path, count: int = 1, spacing_px: float = 40.0, authors: bool = True) -> Path:
    """Pictures of upright rows, row 0 at the centre; the authors' rows are the true ones."""
    folder = data / "crbd"
    truth = "\n".join([f"0.000000\t{spacing_px:.6f}"] * HEIGHT)
    detected = "\n".join(
        "\t".join(f"{WIDTH / 2 + k * spacing_px:.6f}" for k in (-1, 0, 1)) for _ in range(HEIGHT)
    )
    for number in range(count):
        write_picture(folder / "images" / f"crop_row_{number:03}.jpg")
        write_text(folder / "gt" / f"crop_row_{number:03}.crp", truth)
        if authors:
            write_text(folder / "tmgem" / f"crop_row_{number:03}.tmg", detected)
    return folder


def lincoln_set(data: Path, rows: Sequence[Sequence] = (), count: int = 1) -> Path:
    """So many pictures of the Lincoln set's size, each with the same annotated rows."""
    folder, truth = data / "crdld", {"_meta": {"size": [512, 512]}}
    for number in range(count):
        truth[f"{number}.jpg"] = [[list(point) for point in row] for row in rows]
        write_picture(folder / "images" / f"{number}.jpg", (512, 512))
    write_text(folder / "rows.json", json.dumps(truth))
    return folder


def write_text(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def found(lines: Sequence[tuple[float, ...]]) -> FoundRows:
    """Straight rows: x at the top, x at the bottom, confidence (1 unless given)."""
    rows = tuple(RowLine(*line) for line in lines)
    paths = [[(row.x_top_px, 0.0), (row.x_bottom_px, HEIGHT - 1.0)] for row in rows]
    return FoundRows(rows, np.array(paths, dtype=np.float64).reshape(-1, 2, 2))


def finder(
    lines: Sequence[tuple[float, ...]], by_crop: Mapping[str, Sequence[tuple]] | None = None
) -> Finder:
    """Reports the lines, or those of the crop's profile where there are some."""

    def find(image: Image, crop: CropProfile | None) -> FoundRows:
        return found((by_crop or {}).get(crop.name if crop else "", lines))

    return find


@pytest.fixture(scope="session")
def photos() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    return SimpleNamespace(
        near_nadir=near_nadir_set,
        crbd=crbd_set,
        lincoln=lincoln_set,
        picture=write_picture,
        found=found,
        finder=finder,
        size=(WIDTH, HEIGHT),
        rows=tuple(row[:2] for row in ROWS),
    )
