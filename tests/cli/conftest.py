"""Pictures of drawn rows, and what `fieldnav detect` printed of them."""

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest

from fieldnav.messages import Image
from fieldnav.pinhole import Pinhole
from fieldnav.settings.loading import load_robot

SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
ROW_SPACING_M, PLANT_SPACING_M, LEAF_M = 0.35, 0.15, 0.06


def camera(width_px: int, height_px: int) -> Pinhole:
    settings = load_robot("bonnbot").cameras.front
    return settings.model_copy(update={"width_px": width_px, "height_px": height_px}).pinhole()


def field(view: Pinhole, bend_per_m: float = 0.0, furthest_m: float = 2.5, rows: int = 3) -> Image:
    """Discs of leaf along rows, as this camera sees them; they bend to the left."""
    image = np.full((view.height_px, view.width_px, 3), SOIL_BGR, np.uint8)
    for row in range(rows):
        y = ((rows - 1) / 2 - row) * ROW_SPACING_M
        for x in np.arange(0.5, furthest_m, PLANT_SPACING_M):
            u, v = view.to_image(np.array([x, y + bend_per_m * x * x / 2]))
            radius = float(view.pixels_per_metre(v)) * LEAF_M
            cv2.circle(image, (round(u), round(v)), round(radius), LEAF_BGR, cv2.FILLED)
    return image


@pytest.fixture(scope="session")
def plots() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    return SimpleNamespace(camera=camera, field=field, soil_bgr=SOIL_BGR, leaf_bgr=LEAF_BGR)


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    path = tmp_path / "in" / "field.png"
    path.parent.mkdir()
    cv2.imwrite(str(path), field(camera(1280, 720)))
    return path


@pytest.fixture
def objects(capsys: pytest.CaptureFixture[str]) -> Callable[[], list[dict[str, Any]]]:
    """Gives the JSON objects on standard output, one a line."""
    return lambda: [json.loads(line) for line in capsys.readouterr().out.splitlines()]


@pytest.fixture
def error(capsys: pytest.CaptureFixture[str]) -> Callable[[], str]:
    """Gives the one line on standard error; nothing may stand on standard output."""

    def line() -> str:
        captured = capsys.readouterr()
        lines = captured.err.splitlines()
        assert captured.out == "" and len(lines) == 1, captured
        return lines[0]

    return line
