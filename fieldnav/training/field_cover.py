"""What hides parts of a field from the camera: the sky, other ground and foliage, a part of the machine."""

import cv2
import numpy as np

from fieldnav.training.canvas import HEIGHT_PX, WIDTH_PX, Y_PX, Canvas, Coverage, Range, blend, chance
from fieldnav.training.colours import any_colour
from fieldnav.training.dead_leaves import any_surface
from fieldnav.training.ground_camera import GroundCamera
from fieldnav.training.surfaces import band, corner, draw_region, draw_sky, foliage, half

MIN_HORIZON_PX, MIN_SKY_PX = -20.0, -10.0  # above the image: clouds or a hedge may still reach into it
SKY_SHARE, MAX_HILL = 0.9, 0.15  # of the images with a horizon; a steeper hill moves it too far
SKY_BELOW_PX: Range = (0, 12)  # far rows melt before the horizon
HIDDEN_BELOW_PX = 6.0
STRAY_SKY_SHARE, STRAY_BELOW_PX = 0.1, (0.0, 20.0)  # a bright strip at the upper edge of any image

PATCHES, PATCH_SHARES = (0, 1, 2), (0.6, 0.3, 0.1)
PATCH_REGIONS = (half, corner, corner, band)
FOLIAGE_SHARE = 0.7

MACHINE_SHARE = 0.12
MACHINE_PX, MACHINE_TOP_HEIGHTS = (3.0, 30.0), (0.5, 1.0)
MACHINE_SATURATION, MACHINE_VALUE = (0.0, 200.0), (5.0, 200.0)


def hide_parts(random: np.random.Generator, canvas: Canvas, camera: GroundCamera) -> Coverage:
    """Draw what hides parts of the field; changes `canvas` and returns how far each pixel is hidden."""
    horizon_px = _draw_horizon(random, canvas, camera)
    hidden = (horizon_px > Y_PX).astype(np.float32)
    for _ in range(random.choice(PATCHES, p=PATCH_SHARES)):
        region = draw_region(random, PATCH_REGIONS)
        blend(canvas, foliage(random) if chance(random, FOLIAGE_SHARE) else any_surface(random), region)
        hidden = np.maximum(hidden, region)
    if chance(random, MACHINE_SHARE):
        _draw_machine(random, canvas, hidden)
    return hidden


def _draw_horizon(random: np.random.Generator, canvas: Canvas, camera: GroundCamera) -> float:
    """Draw a sky if there is one, and return the image row above which it hides the field."""
    horizon_px = camera.horizon_px
    if horizon_px > MIN_HORIZON_PX and chance(random, SKY_SHARE) and abs(camera.hill) < MAX_HILL:
        height = min(max((HEIGHT_PX / 2 - horizon_px) / HEIGHT_PX, 0.0), 1.0)
        horizon_px -= camera.hill * HEIGHT_PX * height**2
        if horizon_px <= MIN_SKY_PX:
            return 0.0
        draw_sky(random, canvas, horizon_px + random.uniform(*SKY_BELOW_PX))
        return horizon_px + HIDDEN_BELOW_PX
    if horizon_px > 0 or chance(random, STRAY_SKY_SHARE):
        bottom_px = max(horizon_px, 0) + random.uniform(*STRAY_BELOW_PX)
        draw_sky(random, canvas, bottom_px)
        return bottom_px
    return 0.0


def _draw_machine(random: np.random.Generator, canvas: Canvas, hidden: Coverage) -> None:
    """A part of the machine that reaches into the image from below; changes both arrays."""
    middle_px, width_px = random.uniform(0, WIDTH_PX), random.uniform(*MACHINE_PX)
    top = int(random.uniform(*MACHINE_TOP_HEIGHTS) * HEIGHT_PX)
    left, right = int(middle_px - width_px / 2), int(middle_px + width_px / 2)
    colour = any_colour(random, MACHINE_SATURATION, MACHINE_VALUE)
    cv2.rectangle(canvas, (left, top), (right, HEIGHT_PX), colour.tolist(), -1)
    hidden[top:, max(0, left) : right] = 1
