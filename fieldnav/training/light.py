"""Light and camera: what makes a drawn canvas an image as a camera delivers it."""

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.training.canvas import (
    HEIGHT_PX,
    WHITE,
    WIDTH_PX,
    X_PX,
    Y_PX,
    Canvas,
    Coverage,
    Range,
    chance,
    smooth_noise,
    soften,
)
from fieldnav.training.surfaces import COARSE_OCTAVES, draw_region

Image = NDArray[np.uint8]
"""Shape (HEIGHT_PX, WIDTH_PX, 3), channels blue, green, red."""

SHADED_SHARE, SHADING = 0.5, (0.05, 0.35)  # uneven light; deviation of the logarithm
SHADOW_SHARE, SHADOW_DEPTH = 0.35, (0.3, 0.75)  # one large hard shadow
STRIPED_SHARE, STRIPE_DEPTH = 0.15, (0.2, 0.6)  # shadows of masts, trees or the machine's frame
STRIPES, STRIPE_LEVEL, STRIPE_PHASE_RAD = (0.5, 4.0), (0.0, 0.8), (0.0, 6.0)
STRIPE_BEND_PX, STRIPE_BLUR_PX = 6.0, 2.0
FLARE_SHARE, FLARE, FLARE_PX = 0.2, (60.0, 200.0), (20.0, 120.0)
FLARE_FROM_PX, FLARE_TO_HEIGHTS = -20.0, 0.4

GAIN, OFFSET = (0.6, 1.35), (-15.0, 25.0)  # of the exposure; grey levels
WHITE_BALANCE = 0.06  # standard deviation of each channel's gain
SATURATION: Range = (0.5, 1.4)
GAMMA: Range = (0.7, 1.4)
BLURRED_SHARE, BLUR_PX = 0.4, (0.3, 1.1)
NOISE: Range = (0, 8)  # grey levels
JPEG_SHARE, JPEG_QUALITY = 0.4, (35, 95)  # from, and below


def expose(random: np.random.Generator, canvas: Canvas) -> Image:
    """The image of a canvas in some light and by some camera."""
    lit = _illuminate(random, canvas)
    image = _develop(random, np.clip(lit, 0, WHITE).astype(np.float32))
    if not chance(random, JPEG_SHARE):
        return image
    quality = int(random.integers(*JPEG_QUALITY))
    _, encoded = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    return np.asarray(cv2.imdecode(encoded, cv2.IMREAD_COLOR), np.uint8)


def _illuminate(random: np.random.Generator, canvas: Canvas) -> NDArray[np.floating]:
    """Uneven light, shadows and flare."""
    lit: NDArray[np.floating] = canvas
    if chance(random, SHADED_SHARE):
        deviation = random.uniform(*SHADING)
        lit = lit * np.exp(smooth_noise(random, COARSE_OCTAVES) * deviation)[..., None]
    if chance(random, SHADOW_SHARE):
        lit = lit * (1 - draw_region(random) * random.uniform(*SHADOW_DEPTH))[..., None]
    if chance(random, STRIPED_SHARE):
        lit = lit * (1 - _stripes(random) * random.uniform(*STRIPE_DEPTH))[..., None]
    if chance(random, FLARE_SHARE):
        lit = lit + _flare(random)[..., None]
    return lit


def _stripes(random: np.random.Generator) -> Coverage:
    angle = random.uniform(0, np.pi)
    bend_px = smooth_noise(random, COARSE_OCTAVES) * STRIPE_BEND_PX
    distance = (X_PX * np.cos(angle) + Y_PX * np.sin(angle) + bend_px) / WIDTH_PX
    wave = np.cos(distance * 2 * np.pi * random.uniform(*STRIPES) + random.uniform(*STRIPE_PHASE_RAD))
    return soften(wave > random.uniform(*STRIPE_LEVEL), STRIPE_BLUR_PX)


def _flare(random: np.random.Generator) -> Coverage:
    """Light scattered about the sun in grey levels, shape (HEIGHT_PX, WIDTH_PX)."""
    x, y = random.uniform(0, WIDTH_PX), random.uniform(FLARE_FROM_PX, HEIGHT_PX * FLARE_TO_HEIGHTS)
    strength, radius_px = random.uniform(*FLARE), random.uniform(*FLARE_PX)
    return np.asarray(
        strength * np.exp(-((X_PX - x) ** 2 + (Y_PX - y) ** 2) / (2 * radius_px**2)), np.float32
    )


def _develop(random: np.random.Generator, lit: Canvas) -> Image:
    """Exposure, colours, focus and noise of the camera."""
    image = lit * random.uniform(*GAIN) + random.uniform(*OFFSET)
    image = image * (1 + random.normal(0, WHITE_BALANCE, 3))
    grey = image.mean(axis=2, keepdims=True)
    image = grey + (image - grey) * random.uniform(*SATURATION)
    image = WHITE * np.clip(image / WHITE, 0, 1) ** random.uniform(*GAMMA)
    if chance(random, BLURRED_SHARE):
        image = cv2.GaussianBlur(image, (0, 0), random.uniform(*BLUR_PX))
    image = image + random.normal(0, random.uniform(*NOISE), image.shape)
    return np.asarray(np.clip(image, 0, WHITE), np.uint8)
