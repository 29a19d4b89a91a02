"""How far one levelled picture stands beside another, told by the plants that both show.

Rows repeat, plants do not: the whole picture tells one row from the next where the rows' places cannot. Where
nothing but rows is to be seen, the motion nearest to the expected one is taken.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from scipy import fft

from fieldnav.messages import Floats
from fieldnav.perception.counting.levelled import PLACES, STEP, Levelled, Levels

LEAST_OVERLAP = 0.3  # of the ground that one picture shows, which the other must show too
SURPRISE = 1.0  # of likeness that a motion loses which is one row spacing off the expected one
ACROSS, ALONG = (
    2.0,
    2.0,
)  # places and bands: standard deviation of the blur; a camera that nods moves plants by one
BINS = int(fft.next_fast_len(2 * len(PLACES), real=True))  # of transforms: shifts do not wrap around
LAGS: Floats = np.asarray(fft.fftfreq(BINS, 1 / BINS)) * STEP


@dataclass(frozen=True, slots=True)
class Shift:
    """How far right of the first picture the second was taken, in widths; likeness of the two: -1 to 1."""

    widths: float
    likeness: float


UNLIKE = Shift(0.0, 0.0)


def shift_between(first: Levelled, second: Levelled, expected: float, spacing: float) -> Shift:
    """The shift at which two pictures are most alike; expected, spacing: in widths."""
    a, b = _about_mean(first), _about_mean(second)
    energy = _correlated(a * a, second.seen) * _correlated(first.seen, b * b)
    overlap = _correlated(first.seen, second.seen)
    most = max(float(first.seen.sum()), float(second.seen.sum()))
    # Rounding leaves a little energy where there is none.
    allowed = (overlap > LEAST_OVERLAP * most) & (energy > np.finfo(np.float32).eps * energy.max())
    if not allowed.any():
        return UNLIKE
    likeness = np.where(allowed, _correlated(a, b) / np.sqrt(np.where(allowed, energy, 1)), -1)
    judged = np.where(allowed, likeness - SURPRISE * ((LAGS - expected) / spacing) ** 2, -np.inf)
    best = int(judged.argmax())
    return Shift(float(LAGS[best] + STEP * _between(likeness, best)), float(likeness[best]))


def _about_mean(picture: Levelled) -> Levels:
    """Strength about each band's mean, blurred; 0 where nothing is seen."""
    soft = cv2.GaussianBlur(picture.strength, (0, 0), ACROSS, sigmaY=ALONG)
    count = np.maximum(picture.seen.sum(axis=1, keepdims=True), 1)
    mean = (soft * picture.seen).sum(axis=1, keepdims=True) / count
    return np.asarray((soft - mean) * picture.seen, np.float32)


def _correlated(first: Levels, second: Levels) -> Floats:
    """Sum over bands and places of first(x + lag) second(x) for each of LAGS."""
    product = fft.rfft(first, BINS, axis=1) * fft.rfft(second, BINS, axis=1).conj()
    return np.asarray(fft.irfft(product.sum(axis=0), BINS), float)


def _between(curve: Floats, peak: int) -> float:
    """How far from a peak the parabola through it and its neighbours is highest, in places."""
    before, at, after = curve[peak - 1], curve[peak], curve[(peak + 1) % len(curve)]
    bend = before - 2 * at + after
    return float(np.clip((before - after) / (2 * bend), -1 / 2, 1 / 2)) if bend < 0 else 0.0
