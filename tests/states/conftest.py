"""A drawn field and what a behaviour is told of it, without a robot, a clock or a bus."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import radians, tan
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.messages import CameraName, Frame, Image, Side
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop
from states.behaviour import Observation, Task

SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
LEAF = 0.4
"""Radius of a drawn plant over the canopy's width."""
TICK_S = 1 / 15

CAMERA = Pinhole(640, 360, 320 / tan(radians(69) / 2), 1.0, radians(65), 0.75)


def rows(crop: CropProfile, from_m: float = 0.4, to_m: float = 2.6, offset_m: float = 0.0) -> np.ndarray:
    """Where the plants of a lane stand, shape (n, 2), in a camera's ground coordinates."""
    along = np.arange(from_m, to_m, crop.plants.spacing_m)
    count = crop.rows.per_lane
    places = [offset_m + ((count - 1) / 2 - row) * crop.rows.spacing_m for row in range(count)]
    return np.array([[x, y] for y in places for x in along]).reshape(-1, 2)


def picture(crop: CropProfile, plants_m: np.ndarray, camera: Pinhole = CAMERA) -> Image:
    """Discs of leaf where the plants stand, bare soil elsewhere."""
    image = np.full((camera.height_px, camera.width_px, 3), SOIL_BGR, np.uint8)
    plane = canopy_plane(camera, crop)
    for u, v in plane.to_image(plants_m.reshape(-1, 2)):
        if np.isfinite([u, v]).all() and abs(u) < 2 * camera.width_px and abs(v) < 2 * camera.height_px:
            radius = float(plane.pixels_per_metre(v)) * LEAF * crop.plants.canopy_width_m
            cv2.circle(image, (round(u), round(v)), max(1, round(radius)), LEAF_BGR, cv2.FILLED)
    return image


@dataclass
class Situation:
    """Where the robot is and what it sees; `seen` is the observation of the next tick."""

    now_s: float = 0.0
    forward_m: float = 0.0
    sideways_m: float = 0.0
    stopped: bool = True
    aligned: bool = True
    ready: bool = True
    sequence: int = 0

    def seen(self, images: Mapping[CameraName, Image] | None = None, dt_s: float = TICK_S) -> Observation:
        self.now_s += dt_s
        self.sequence += 1
        frames = {
            name: Frame(name, self.sequence, self.now_s, image) for name, image in (images or {}).items()
        }
        return Observation(
            now_s=self.now_s,
            frames=frames,
            forward_m=self.forward_m,
            sideways_m=self.sideways_m,
            stopped=self.stopped,
            wheels_aligned=self.aligned,
            wheels_ready=self.ready,
        )


@pytest.fixture(scope="session")
def drawn() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    crop = load_crop("sugar-beet")
    task = Task(crop, dict.fromkeys(CameraName, CAMERA), Side.RIGHT, lanes=2)
    return SimpleNamespace(
        crop=crop, task=task, camera=CAMERA, rows=rows, picture=picture, situation=Situation
    )
