"""Rendered plots that no crop row shows in: bare soil, weeds alone, the headland, a machine's tracks."""

from dataclasses import fields, replace
from math import pi

import cv2
import numpy as np

from fieldnav.evaluation.rendered_rows import AZIMUTH_DEG, TILT_DEG
from fieldnav.evaluation.rendered_scene import Place, Scene
from fieldnav.evaluation.rowless_pictures import Maker
from fieldnav.messages import Image, Side
from fieldnav.settings.field import FieldSettings, Ground, Light, Weeds
from fieldnav.settings.loading import load_crop
from fieldnav.simulation.plan import sow
from fieldnav.simulation.stand import Stand

SEEDS = 10_000  # of plots to draw from
PLOT_M = 12.0  # length of the plots
BEYOND_M = 0.4  # how far past the rows' ends the robot stands on the headland
SOILS_BGR = ((72, 96, 122), (40, 55, 70), (110, 140, 165), (60, 80, 140), (95, 105, 110), (50, 70, 80))
HEADLAND = (0.0, 5.0)  # weeds to a square metre
SKEW_RAD, AHEAD_RAD = pi / 3, 0.1  # most that the robot is turned in a plot without rows, past rows' ends
RUT_BRIGHTNESS = 0.65  # of the soil's beside it
RUT_WIDTH, RUT_PLACES = 0.12, (0.2, 0.35)  # over the picture's width at its lower edge; places off its middle
FAR_SCALE = 0.6  # of both, at the upper edge


def bare_soil(random: np.random.Generator) -> Image:
    """Soil of some colour and roughness under some sun."""
    return _without_crop(random, Weeds(per_m2=0, headland_per_m2=0))


def weeds(per_m2: tuple[float, float], size_m: tuple[float, float], patches: float) -> Maker:
    """Weeds alone, of this size, so many a square metre, this share of them in patches."""
    return lambda random: _without_crop(
        random, Weeds(per_m2=random.uniform(*per_m2), size_m=size_m, patches=patches)
    )


def headland(random: np.random.Generator) -> Image:
    """What lies beyond the rows' ends."""
    plot = _plot(random, Weeds(headland_per_m2=random.uniform(*HEADLAND)))
    crop = load_crop(plot.crop)
    scene = Scene(plot, crop, sow(plot, crop, Side.RIGHT))
    place = Place(0, PLOT_M + BEYOND_M, 0.0, random.uniform(-AHEAD_RAD, AHEAD_RAD))
    return scene.shoot(place, _tilt_rad(random), random).image


def _without_crop(random: np.random.Generator, weedy: Weeds) -> Image:
    """A picture from the middle of a plot of which but one plant, far out of sight, came up."""
    plot = _plot(random, weedy)
    crop = load_crop(plot.crop)
    plan = sow(plot, crop, Side.RIGHT)
    kept = ~plan.plants.is_crop
    kept[0] = True
    stand = Stand(*(getattr(plan.plants, field.name)[kept] for field in fields(Stand)))
    scene = Scene(plot, crop, replace(plan, plants=stand))
    place = Place(0, PLOT_M / 2, 0.0, random.uniform(-SKEW_RAD, SKEW_RAD))
    return scene.shoot(place, _tilt_rad(random), random).image


def _plot(random: np.random.Generator, weedy: Weeds) -> FieldSettings:
    roughness, residue, stones, sunshine = random.uniform(0, 1, 4)
    colour = SOILS_BGR[int(random.integers(len(SOILS_BGR)))]
    return FieldSettings(
        name="plot",
        crop="sugar-beet",
        lanes=1,
        length_m=PLOT_M,
        seed=int(random.integers(SEEDS)),
        weeds=weedy,
        light=Light(sun_azimuth_deg=random.uniform(*AZIMUTH_DEG), sunshine=sunshine),
        ground=Ground(colour_bgr=colour, roughness=roughness, residue=residue, stones=stones),
    )


def _tilt_rad(random: np.random.Generator) -> float:
    return float(np.radians(random.uniform(*TILT_DEG)))


def tyre_tracks(random: np.random.Generator) -> Image:
    """Bare soil with the two dark bands that a machine's wheels left."""
    image = bare_soil(random)
    height, width = image.shape[:2]
    light = np.ones((height, width, 1), np.float32)
    for side in (-1, 1):
        middle = side * random.uniform(*RUT_PLACES)
        edges = np.array([middle - RUT_WIDTH / 2, middle + RUT_WIDTH / 2])
        across = np.concatenate([edges * FAR_SCALE, edges[::-1]]) + 1 / 2
        corners = np.stack([across * width, [0, 0, height, height]], axis=-1)
        cv2.fillConvexPoly(light, corners.round().astype(np.int32), RUT_BRIGHTNESS)
    return np.asarray(image * light, dtype=np.uint8)
