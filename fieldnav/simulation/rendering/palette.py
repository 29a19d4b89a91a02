"""The picture's 256 colours: one ramp of soil, and for each species a table of tones by brightness.

The field is painted as numbers of colours, one byte a pixel, and coloured last, in one look-up.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.simulation.texture import SOIL_MEAN, SOIL_STEPS

COLOURS = 256
CROP_TONES, CROP_LIGHTS = 6, 14
WEED_TONES = 1  # many steps of brightness rather, else the mottle blotches large leaves
MIDDLE_TONE = 0.5
MOTTLE = 2  # steps of brightness, up and down, that are added to the painted number for texture
DARKEST, BRIGHTEST = 0.3, 1.15  # brightness of leaves at the two ends of what is painted
STRAW_BGR = (150.0, 196.0, 214.0)
STRAW_FROM = 1.45  # over the soil's own brightness: where the ramp turns to the colour of straw and stones
SHADE_BGR = (1.12, 1.0, 0.94)  # the sky's colour in dark places
LEAF_SHADE_BGR = (1.1, 1.0, 0.95)


@dataclass(frozen=True, slots=True)
class Band:
    """The colours of one species: `tones` rows of `lights` entries from `first` on.

    The last 2 MOTTLE entries of a row are never painted; adding 0 to 2 MOTTLE stays within the row.
    """

    first: int
    tones: int
    lights: int

    @property
    def light(self) -> Floats:
        """Brightness of the entries of a row, shape (lights,), once the mottle is added."""
        step = (BRIGHTEST - DARKEST) / (self.lights - 1 - 2 * MOTTLE)
        return np.asarray(DARKEST + step * (np.arange(self.lights) - MOTTLE), dtype=float)

    def pick(self, tone: NDArray[np.float32], brightness: NDArray[np.float32]) -> NDArray[np.uint8]:
        """Colour numbers for leaves of a tone, 0 to 1, and a brightness; all of shape (n,)."""
        row = np.clip(np.rint(tone * (self.tones - 1)), 0, self.tones - 1)
        painted = self.lights - 1 - 2 * MOTTLE
        step = (brightness - DARKEST) / (BRIGHTEST - DARKEST) * painted
        column = np.clip(np.rint(step), 0, painted)
        return np.asarray(self.first + row * self.lights + column, dtype=np.uint8)


def share_bands(species: int) -> list[Band]:
    """Bands for a crop, first, and its weeds, which share what the crop leaves."""
    crop = Band(SOIL_STEPS, CROP_TONES, CROP_LIGHTS)
    first = crop.first + crop.tones * crop.lights
    lights = (COLOURS - first) // (WEED_TONES * max(species - 1, 1))
    return [crop] + [Band(first + i * WEED_TONES * lights, WEED_TONES, lights) for i in range(species - 1)]


def colour_table(
    soil_bgr: Sequence[int], palettes: Sequence[NDArray[np.uint8]], bands: Sequence[Band]
) -> NDArray[np.uint8]:
    """The colours, shape (256, 1, 3), blue, green, red, as OpenCV's applyColorMap takes them."""
    table = np.zeros((COLOURS, 3))
    table[:SOIL_STEPS] = _soil_ramp(np.array(soil_bgr, float))
    for palette, band in zip(palettes, bands, strict=True):
        table[band.first : band.first + band.tones * band.lights] = _leaf_colours(palette, band)
    return np.clip(np.rint(table), 0, 255).astype(np.uint8)[:, None]


def _soil_ramp(soil_bgr: Floats) -> Floats:
    """From black over the soil's own colour to straw."""
    brightness = np.maximum(np.arange(SOIL_STEPS)[:, None] - MOTTLE, 0) / SOIL_MEAN
    shade = np.clip(1 - brightness, 0, 1)
    soil = soil_bgr * brightness * (shade * SHADE_BGR + (1 - shade))
    pale = np.clip((brightness - STRAW_FROM) / (SOIL_STEPS / SOIL_MEAN - STRAW_FROM), 0, 1)
    return np.asarray(soil * (1 - pale) + pale * np.array(STRAW_BGR))


def _leaf_colours(palette: NDArray[np.uint8], band: Band) -> Floats:
    """A palette's tones, each from dark to bright, shape (tones * lights, 3)."""
    anchors = np.linspace(0, 1, len(palette))
    places = np.linspace(0, 1, band.tones) if band.tones > 1 else np.array([MIDDLE_TONE])
    tones = np.stack([np.interp(places, anchors, palette[:, channel]) for channel in range(3)], axis=-1)
    light = band.light[:, None]
    tint = 1 + (np.array(LEAF_SHADE_BGR) - 1) * np.clip(1 - light, 0, 1)
    return np.asarray((tones[:, None] * light * tint).reshape(-1, 3))
