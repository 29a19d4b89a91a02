"""Pictures whose cost is measured: rendered fields, an emerged crop among weeds, and strewn plants."""

from dataclasses import dataclass
from math import ceil, radians, sqrt

import cv2
import numpy as np

from fieldnav.evaluation.rendered_scene import Place, Scene
from fieldnav.messages import Image, Side
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.plan import sow

ROBOT, FIELD, CROP = "bonnbot", "demo", "sugar-beet"
"""What every figure of speed is of, unless it says otherwise."""
EMERGED = {
    "rows": {"per_lane": 8, "spacing_m": 0.125},  # as farms drill it
    "plants": {"spacing_m": 0.02, "canopy_width_m": 0.03, "canopy_height_m": 0.06},
}
WEEDY = {
    "per_m2": 60.0,
    "size_m": [0.02, 0.04],
    "patches": 0.0,
    "large": 0.0,
    "lines": 0.0,
}  # together some 250 plants in view
STREWN_RADIUS_M = 0.012  # of a plant; just above the profile's smallest area
STREWN_PLACE = (0.35, 0.65)  # of its cell's width and height, where a plant may stand
SOIL_BGR, LEAF_BGR, GRAIN = (72, 96, 122), (50, 150, 70), 3.0  # colours, and their noise in grey levels
WORKING_TILT_RAD = radians(65)  # paper
BRIGHTEST = 255


@dataclass(frozen=True, slots=True)
class Sample:
    """A picture, 1280x720, of a crop, and the camera that took it."""

    image: Image
    crop: CropProfile
    camera: Pinhole


def rendered_sample(field_name: str, crop: CropProfile, **changes: object) -> Sample:
    """The middle of the first lane of a shipped field, with a crop sown in it."""
    field = revised(load_field(field_name), changes)
    scene = Scene(field, crop, sow(field, crop, Side.RIGHT), ROBOT)
    shot = scene.shoot(Place(0, field.length_m / 2), WORKING_TILT_RAD, np.random.default_rng(field.seed))
    return Sample(shot.image, crop, shot.camera)


def crowded_sample() -> Sample:
    """Winter wheat just emerged, among weeds: some 250 plants that stand apart."""
    return rendered_sample(FIELD, revised(load_crop("winter-wheat"), EMERGED), weeds=WEEDY)


def strewn_sample(count: int) -> Sample:
    """So many round plants on bare soil, each in a cell of its own so that none touch."""
    random, crop = np.random.default_rng(count), load_crop(CROP)
    camera = load_robot(ROBOT).cameras.front.pinhole()
    cell_px = sqrt(camera.width_px * camera.height_px / count)
    across, down = ceil(camera.width_px / cell_px), ceil(camera.height_px / cell_px)
    cells = np.stack(np.divmod(random.permutation(across * down)[:count], across)[::-1], axis=-1)
    places = (cells + random.uniform(*STREWN_PLACE, cells.shape)) / (across, down)
    image = np.full((camera.height_px, camera.width_px, 3), SOIL_BGR, np.uint8)
    for x, y in places * (camera.width_px, camera.height_px):
        radius_px = STREWN_RADIUS_M * float(camera.pixels_per_metre(y))
        cv2.circle(image, (round(x), round(y)), round(radius_px), LEAF_BGR, cv2.FILLED)
    grain = random.normal(0, GRAIN, image.shape)
    return Sample(np.asarray((image + grain).clip(0, BRIGHTEST), dtype=np.uint8), crop, camera)
