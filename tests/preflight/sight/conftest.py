"""A robot whose cameras are recordings of drawn rows, played on simulated time."""

import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.messages import Image
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.preflight.computer import Computer
from fieldnav.preflight.finding import Finding
from fieldnav.preflight.gear import Gear, opened
from fieldnav.preflight.preflight import preflight
from fieldnav.preflight.waiting import Watch
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop, load_robot
from fieldnav.settings.robot import Robot

SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
GRAIN = 12.0
"""Grey levels of noise: what keeps two pictures of one scene apart, and a picture sharp."""
WIDTH_PX, HEIGHT_PX, RATE_HZ = 640, 360, 15.0
PICTURES = 10


class SightBench:
    """The cameras' folders, what they show, and what is found of them."""

    soil = np.full((HEIGHT_PX, WIDTH_PX, 3), SOIL_BGR, np.uint8)

    def __init__(self, folder: Path, computer: Computer) -> None:
        self._folder, self._computer, self._now_s = folder, computer, 0.0
        self._document = load_robot("bonnbot").model_dump(mode="json")
        size = {"width_px": WIDTH_PX, "height_px": HEIGHT_PX, "rate_hz": RATE_HZ}
        for name in ("front", "rear"):
            self._document["cameras"][name] |= size
        self.crop = load_crop("sugar-beet")
        self.camera = self.robot.cameras.front.pinhole()
        self.show("front", self.lane)
        self.show("rear", lambda seed: self.lane(seed)[:, ::-1] // 2)

    @property
    def robot(self) -> Robot:
        return Robot.model_validate_json(json.dumps(self._document))

    def source(self, camera: str, source: Path | str) -> None:
        self._document["cameras"][camera]["source"] = str(source)

    def show(self, camera: str, picture: Callable[[int], Image]) -> Path:
        """Record what the camera then plays; returns the folder."""
        folder = self._folder / camera
        folder.mkdir(exist_ok=True)
        for seed in range(PICTURES):
            cv2.imwrite(str(folder / f"{seed}.png"), picture(seed))
        self.source(camera, folder)
        return folder

    def check(self, crop: CropProfile | None = None) -> dict[str, Finding]:
        """What is found of the cameras, by check; there is no bus."""
        watch = Watch(lambda: self._now_s, self._wait)
        with opened(self.robot, watch.clock) as (gear, findings):
            looked = preflight(self.robot, crop, Gear(None, gear.cameras), self._computer, watch)
            found = {finding.check: finding for finding in (*findings, *looked)}
        return {check: finding for check, finding in found.items() if "camera" in check}

    def lane(
        self,
        seed: int,
        camera: Pinhole | None = None,
        places: tuple[float, ...] = (0.35, 0.0, -0.35),
        radius_m: float = 0.1,
    ) -> Image:
        """Rows of leaf discs on soil, as a camera sees them; every seed has other grain."""
        image, plane = self.soil.copy(), canopy_plane(camera or self.camera, self.crop)
        for place in places:
            for ahead in np.arange(0.2, 3.5, 0.16) + 0.1 * place:
                u, v = plane.to_image(np.array([ahead, place]))
                if np.isfinite([u, v]).all():
                    across = float(plane.pixels_per_metre(v))
                    along = across * across * plane.height_m / plane.focal_px
                    axes = (max(1, round(radius_m * across)), max(1, round(radius_m * along)))
                    cv2.ellipse(image, (round(u), round(v)), axes, 0, 0, 360, LEAF_BGR, cv2.FILLED)
        return self.grained(image, seed)

    def grained(self, image: Image, seed: int) -> Image:
        noise = np.random.default_rng(seed).normal(0, GRAIN, image.shape)
        return np.asarray(np.clip(image + noise, 0, 255), np.uint8)

    def _wait(self, seconds: float) -> None:
        self._now_s += seconds


@pytest.fixture
def bench(tmp_path: Path, computer: Computer) -> SightBench:
    return SightBench(tmp_path, computer)
