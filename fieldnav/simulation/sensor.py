"""The camera's lens and sensor: softness, motion blur, vignetting, exposure that drifts, noise.

What a frame suffers depends on the seed and the frame's sequence number alone, so frames may be
exposed in any order, or not at all.
"""

from math import hypot, pi, sin, sqrt

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Image
from fieldnav.settings.field import CameraErrors
from fieldnav.simulation.streams import Stream, random_stream

DRIFT_FRAMES = (610.0, 233.0)  # periods of the exposure's drift, 41 s and 16 s at 15 frames/s
DRIFT_WEIGHTS = (0.65, 0.35)
NOISE_MARGIN_PX = 64  # the noise is one fixed picture, shifted by up to this much from frame to frame
LEAST_SHIFT_PX = 0.7  # motion blur by less than this cannot be told from none
LENS_SIGMA_PX = 0.6  # a sharp lens and a colour filter array together
LENS_WINDOW_PX = (3, 3)
FULL = 255


class Sensor:
    """One camera's sensor; `mirrored` flips its noise left to right, as the mirrored field's pictures are."""

    def __init__(
        self, errors: CameraErrors, width: int, height: int, seed: int, mirrored: bool = False
    ) -> None:
        self._errors = errors
        self._seed = seed
        self._mirrored = mirrored
        self._vignette = _vignette(errors.vignetting, width, height)
        self._brighter, self._darker = _noise(errors.noise, width, height, seed, mirrored)
        self._phases = random_stream(seed, Stream.EXPOSURE).uniform(0, 2 * pi, len(DRIFT_FRAMES))

    def expose(self, image: Image, sequence: int, motion_px: tuple[float, float]) -> Image:
        """Change `image`, shape (height, width, 3), into what the sensor gives, in place, and return it.

        motion_px: how far the scene moves over the picture, x and y, while the shutter is open.
        """
        soft = np.asarray(cv2.GaussianBlur(image, LENS_WINDOW_PX, LENS_SIGMA_PX), dtype=np.uint8)
        blurred = _blur(soft, motion_px)
        cv2.multiply(blurred, self._vignette, dst=image, scale=self.gain(sequence) / FULL)
        if self._errors.noise > 0:
            part = self._noise_part(sequence, image)
            cv2.add(image, self._brighter[part], dst=image)
            cv2.subtract(image, self._darker[part], dst=image)
        return image

    def gain(self, sequence: int) -> float:
        """Exposure of a frame over the right one, within 1 plus or minus the drift."""
        waves = zip(DRIFT_WEIGHTS, DRIFT_FRAMES, self._phases, strict=True)
        swing = sum(weight * sin(2 * pi * sequence / period + phase) for weight, period, phase in waves)
        return 1 + self._errors.exposure_drift * swing

    def _noise_part(self, sequence: int, image: Image) -> tuple[slice, slice]:
        """The part of the noise picture that a frame gets."""
        random = random_stream(self._seed, Stream.NOISE, sequence + 1)
        top, left = (int(offset) for offset in random.integers(0, NOISE_MARGIN_PX, 2))
        if self._mirrored:
            left = NOISE_MARGIN_PX - left
        height, width = image.shape[:2]
        return slice(top, top + height), slice(left, left + width)


def _vignette(darkening: float, width: int, height: int) -> Image:
    """Brightness over the picture, 255 in its middle, falling with the square of the distance."""
    x = (np.arange(width) - (width - 1) / 2) / hypot(width, height) * 2
    y = (np.arange(height) - (height - 1) / 2) / hypot(width, height) * 2
    light = FULL * (1 - darkening * (x[None, :] ** 2 + y[:, None] ** 2))
    return np.repeat(np.rint(light).astype(np.uint8)[..., None], 3, axis=2)


def _noise(sigma: float, width: int, height: int, seed: int, mirrored: bool) -> tuple[Image, Image]:
    """What the noise adds and what it takes away, each larger than a frame by NOISE_MARGIN_PX."""
    random = random_stream(seed, Stream.NOISE)
    shape = (height + NOISE_MARGIN_PX, width + NOISE_MARGIN_PX, 3)
    noise = np.rint(sigma * random.standard_normal(shape, dtype=np.float32))
    if mirrored:
        noise = noise[:, ::-1]
    brighter, darker = np.clip(noise, 0, FULL), np.clip(-noise, 0, FULL)
    return np.ascontiguousarray(brighter, dtype=np.uint8), np.ascontiguousarray(darker, dtype=np.uint8)


def _blur(image: Image, motion_px: tuple[float, float]) -> Image:
    """The picture smeared along a motion: averaged with itself shifted by a half of it, a quarter, ..."""
    steps: NDArray[np.float64] = np.array(motion_px, dtype=float) / 2
    while hypot(*steps) >= LEAST_SHIFT_PX:
        image = _averaged(image, steps)
        steps = steps / 2
    return image


def _averaged(image: Image, shift_px: NDArray[np.float64]) -> Image:
    """The mean of a picture and itself shifted; the share of the shifted keeps the smear's variance."""
    x, y = (round(shift) for shift in shift_px)
    if x == 0 and y == 0:
        x, y = (int(np.sign(s)) if abs(s) == np.abs(shift_px).max() else 0 for s in shift_px)
    ratio = min(hypot(*shift_px) / hypot(x, y), 1.0)
    share = (1 - sqrt(1 - ratio**2)) / 2
    height, width = image.shape[:2]
    here = (slice(max(y, 0), height + min(y, 0)), slice(max(x, 0), width + min(x, 0)))
    there = (slice(max(-y, 0), height + min(-y, 0)), slice(max(-x, 0), width + min(-x, 0)))
    result = image.copy()
    cv2.addWeighted(image[here], 1 - share, image[there], share, 0, dst=result[here])
    return result
