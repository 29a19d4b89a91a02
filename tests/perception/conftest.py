"""Drawn fields: green discs along rows, seen by the pinhole camera; every place is known exactly."""

from collections.abc import Sequence
from math import radians, tan
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.messages import Image, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

SOIL_BGR = (72, 96, 122)
LEAF_BGR = (50, 150, 70)
GREY_NOISE = 3.0


def pinhole(width_px: int = 1280) -> Pinhole:
    focal_px = width_px / 2 / tan(radians(69) / 2)
    return Pinhole(width_px, width_px * 9 // 16, focal_px, 1.0, radians(65), 0.75)


def profile(per_lane: int, spacing_m: float, **plants: float) -> CropProfile:
    return CropProfile.model_validate(
        {
            "name": "drawn",
            "growth_stage": "drawn",
            "rows": {"per_lane": per_lane, "spacing_m": spacing_m},
            "plants": {"spacing_m": 0.18, "canopy_width_m": 0.12, "canopy_height_m": 0.08} | plants,
            "tuned_for": "tests",
        }
    )


def stand(
    crop: CropProfile,
    offset_m: float = 0.0,
    slope: float = 0.0,
    scatter_m: float = 0.0,
    ahead_m: tuple[float, float] = (0.6, 2.2),
    without: Sequence[int] = (),
    seed: int = 1,
) -> np.ndarray:
    """Where the plants of a lane stand, shape (n, 2): y = offset + place + slope x, left row first."""
    rng = np.random.default_rng(seed)
    count = crop.rows.per_lane
    along = np.arange(ahead_m[0], ahead_m[1], crop.plants.spacing_m)
    rows = []
    for row in set(range(count)) - set(without):
        place = ((count - 1) / 2 - row) * crop.rows.spacing_m
        x = along + rng.normal(0, scatter_m, along.shape) + (0.3 * crop.plants.spacing_m) * row
        rows.append(np.stack([x, offset_m + place + slope * x + rng.normal(0, scatter_m, x.shape)], axis=-1))
    return np.concatenate(rows)


def draw_field(
    crop: CropProfile,
    camera: Pinhole,
    plants_m: np.ndarray,
    weeds_m: np.ndarray | None = None,
    weed_radius_m: float = 0.02,
    noise: float = GREY_NOISE,
    seed: int = 1,
) -> Image:
    """A picture of discs as wide as the canopy at `plants_m`, and small ones at `weeds_m`."""
    image = np.full((camera.height_px, camera.width_px, 3), SOIL_BGR, np.uint8)
    plane = canopy_plane(camera, crop)
    kinds = [(plants_m, crop.plants.canopy_width_m / 2 * 0.8)]
    if weeds_m is not None:
        kinds.append((weeds_m, weed_radius_m))
    for places, radius_m in kinds:
        for x, y in plane.to_image(places):
            if not np.isfinite([x, y]).all() or abs(x) > 4 * camera.width_px or abs(y) > 4 * camera.height_px:
                continue
            radius = float(plane.pixels_per_metre(y)) * radius_m
            centre = (round(x * 16), round(y * 16))
            cv2.circle(image, centre, round(radius * 16), LEAF_BGR, cv2.FILLED, cv2.LINE_AA, 4)
    grain = np.random.default_rng(seed).normal(0, noise, image.shape)
    return np.asarray(np.clip(image + grain, 0, 255), np.uint8)


def rows_in_image(
    crop: CropProfile, camera: Pinhole, offset_m: float = 0.0, slope: float = 0.0
) -> list[RowLine]:
    """Where the rows of a lane truly lie in the picture, left to right."""
    count, plane = crop.rows.per_lane, canopy_plane(camera, crop)
    places = [((count - 1) / 2 - row) * crop.rows.spacing_m for row in range(count)]
    return [plane.row_in_image(offset_m + place, slope) for place in places]


def strewn(count: int, seed: int) -> np.ndarray:
    """Places of weeds anywhere in the view, shape (count, 2)."""
    rng = np.random.default_rng(seed)
    return np.stack([rng.uniform(0.75, 1.9, count), rng.uniform(-0.9, 0.9, count)], axis=-1)


@pytest.fixture(scope="session")
def drawn() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    return SimpleNamespace(
        camera=pinhole(),
        pinhole=pinhole,
        beet=profile(per_lane=3, spacing_m=0.35),
        profile=profile,
        stand=stand,
        picture=draw_field,
        rows=rows_in_image,
        strewn=strewn,
        soil=SOIL_BGR,
    )
