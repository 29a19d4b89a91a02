"""Drawn pictures that no crop row shows in: sky, grass, single colours, noise."""

from collections.abc import Callable

import cv2
import numpy as np

from fieldnav.messages import Floats, Image

Maker = Callable[[np.random.Generator], Image]

BRIGHTEST, GREY = 255, 128  # grey levels
SHAPE = (720, 1280)  # height, width
SIZES_PX = ((9, 9), (2000, 16), (48, 64), (16, 2000))  # the odd ones
SKY_BGR, HAZE_BGR = (200, 130, 60), (240, 210, 180)
GRASS_BGR, GRASS_SHADES_BGR = (45, 120, 70), (15, 40, 20)  # middle colour and its standard deviation
BLADE_PX = (1.0, 9.0)  # half width and half height, about
CLOUD_PX = 60.0
NOISE_SIGMA = 40.0  # the most, in grey levels
SALT_SHARE = 0.05  # and as much pepper
JPEG_QUALITY = 25  # per cent; below the camera's, so that the blocks show


def sky(random: np.random.Generator) -> Image:
    """Blue, paler downwards."""
    down = np.linspace(0, random.uniform(), SHAPE[0])[:, None, None]
    column = np.array(SKY_BGR) * (1 - down) + np.array(HAZE_BGR) * down
    return np.asarray(np.repeat(column, SHAPE[1], axis=1), dtype=np.uint8)


def clouds(random: np.random.Generator) -> Image:
    """White patches before the blue."""
    blur = cv2.GaussianBlur(random.standard_normal(SHAPE), (0, 0), CLOUD_PX)
    white = (blur / blur.std()).clip(0, 1)[..., None]
    return np.asarray(sky(random) * (1 - white) + BRIGHTEST * white, dtype=np.uint8)


def grass(random: np.random.Generator) -> Image:
    """Blades of all greens over the whole picture."""
    blades = cv2.GaussianBlur(random.standard_normal(SHAPE), (0, 0), BLADE_PX[0], sigmaY=BLADE_PX[1])
    shade = (blades / blades.std())[..., None]
    return _clipped(np.array(GRASS_BGR) + shade * np.array(GRASS_SHADES_BGR))


def plain(colour_bgr: tuple[int, int, int]) -> Maker:
    """One colour all over."""
    return lambda random: np.full((*SHAPE, 3), colour_bgr, np.uint8)


def uniform_noise(random: np.random.Generator) -> Image:
    """Every level alike, to a brightness that is drawn."""
    return random.integers(0, random.integers(2, BRIGHTEST + 1), (*SHAPE, 3), dtype=np.uint8, endpoint=True)


def gaussian_noise(random: np.random.Generator) -> Image:
    """Normally distributed about grey."""
    return _clipped(random.normal(GREY, random.uniform(0, NOISE_SIGMA), (*SHAPE, 3)))


def salt_and_pepper(random: np.random.Generator) -> Image:
    """White and black pixels on grey, each channel by itself."""
    drawn = random.uniform(0, 1, (*SHAPE, 3))
    levels = [drawn < SALT_SHARE, drawn > 1 - SALT_SHARE]
    return np.asarray(np.select(levels, [BRIGHTEST, 0], GREY), dtype=np.uint8)


def compressed_noise(random: np.random.Generator) -> Image:
    """Noise after JPEG: blocks of eight pixels in rows and columns."""
    _, content = cv2.imencode(".jpg", gaussian_noise(random), [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    return np.asarray(cv2.imdecode(content, cv2.IMREAD_COLOR), dtype=np.uint8)


def odd_sizes(random: np.random.Generator) -> Image:
    """Noise in pictures far smaller, longer or taller than a camera's."""
    shape = SIZES_PX[int(random.integers(len(SIZES_PX)))]
    return random.integers(0, BRIGHTEST, (*shape, 3), dtype=np.uint8, endpoint=True)


def _clipped(values: Floats) -> Image:
    return np.asarray(values.clip(0, BRIGHTEST), dtype=np.uint8)
