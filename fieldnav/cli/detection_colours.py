"""Colours of detection pictures: told apart on leaves and on soil, on a screen in the sun."""

import numpy as np
from matplotlib.colors import LinearSegmentedColormap, to_hex
from matplotlib.patheffects import AbstractPathEffect, withStroke

INK, PAPER, GRID = "#2b2b2b", "#fbfaf7", "#dddad2"
"""Of writing, of what it stands on, and of lines that only help the eye."""
SHADOW, LIGHT = "#14171a", "#ffffff"
PLANT = "#ff3fd0"
LANE = "#ffffff"
LEAF_BGR = np.array([60, 255, 140], np.float32)
SIGNAL, PEAK, TROUGH = "#2f6db3", "#c8352b", "#1f7a33"
CONFIDENCE = LinearSegmentedColormap.from_list(
    "confidence", [(0.0, "#ff2d1a"), (0.5, "#ff7a00"), (0.75, "#ffd800"), (0.9, "#f6fdf0"), (1.0, "#2ff3ff")]
)
"""From red, hardly believed, over yellow and white to cyan, sure: no leaf and no soil has these."""


def of_confidence(confidence: float) -> str:
    """A row's colour; confidence within 0 and 1."""
    return str(to_hex(CONFIDENCE(confidence)))


def edged(width: float) -> list[AbstractPathEffect]:
    """A dark edge about a line or writing, in points: it keeps both legible on anything."""
    return [withStroke(linewidth=width, foreground=SHADOW)]
