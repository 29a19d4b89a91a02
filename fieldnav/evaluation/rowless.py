"""Pictures without a crop row, made here, and the share of them in which perception rightly reports none."""

from collections.abc import Callable
from dataclasses import fields, replace
from itertools import cycle
from math import pi

import cv2
import numpy as np

from fieldnav.evaluation.benchmark import Figure, Plan, Progress
from fieldnav.evaluation.rendered_rows import AZIMUTH_DEG, CROPS, TILT_DEG, Place, Scene
from fieldnav.messages import Image, Side
from fieldnav.perception.perceive import View, find
from fieldnav.perception.unposed import find_unposed
from fieldnav.pinhole import Pinhole
from fieldnav.settings.field import FieldSettings, Ground, Light, Weeds
from fieldnav.settings.loading import load_crop, load_robot
from fieldnav.simulation.plan import sow
from fieldnav.simulation.stand import Stand

Maker = Callable[[np.random.Generator], Image]

IMAGES, QUICK_IMAGES = 9, 2  # of each kind
KNOWN = "pictures without a row reported (share)"
UNKNOWN = "pictures without a row reported, camera not known (share)"
REPORTED = 0.5  # confidence from which a row counts as reported
FULL, GREY = 255, 128  # grey levels
SEEDS = 10_000  # of plots to draw from
PLOT_M = 12.0  # length of the rendered plots
BEYOND_M = 0.4  # how far past the rows' ends the robot stands on the headland
SOILS_BGR = ((72, 96, 122), (40, 55, 70), (110, 140, 165), (60, 80, 140), (95, 105, 110), (50, 70, 80))
SMALL_M, LARGE_M = (0.02, 0.05), (0.08, 0.20)  # diameter of weeds
SPARSE, DENSE, HEADLAND = (2.0, 20.0), (20.0, 60.0), (0.0, 5.0)  # weeds to a square metre
SKEW_RAD, AHEAD_RAD = pi / 3, 0.1  # most that the robot is turned in a plot without rows, past rows' ends
SHAPE = (720, 1280)  # of drawn pictures
SIZES_PX = ((9, 9), (2000, 16), (48, 64), (16, 2000))  # height, width
GREEN_BGR, SKY_BGR, HAZE_BGR = (40, 160, 60), (200, 130, 60), (240, 210, 180)
GRASS_BGR, GRASS_SHADES_BGR = (45, 120, 70), (15, 40, 20)  # middle colour and its standard deviation
BLADE_PX = (1.0, 9.0)  # half width and half height, about
CLOUD_PX = 60.0
NOISE_SIGMA = 40.0  # the most, in grey levels
SALT_SHARE = 0.05  # and as much pepper
JPEG_QUALITY = 25  # per cent; below the camera's, so that the blocks show
RUT_BRIGHTNESS = 0.65  # of the soil's beside it
RUT_WIDTH, RUT_PLACES = 0.12, (0.2, 0.35)  # over the picture's width at its lower edge; places off its middle
FAR_SCALE = 0.6  # of both, at the upper edge


def rowless(plan: Plan, progress: Progress) -> list[Figure]:
    """Two figures a kind of picture, with the camera known and without, and two of all kinds together."""
    count = QUICK_IMAGES if plan.quick else IMAGES
    figures = [figure for kind in KINDS for figure in kind_figures(kind, count, plan.seed, progress)]
    for metric in (KNOWN, UNKNOWN):
        shares = [figure.value for figure in figures if figure.metric == metric]
        figures.append(Figure("no rows: all kinds", metric, float(np.mean(shares)), goal=1.0))
    return figures


def kind_figures(kind: str, count: int, seed: int, progress: Progress) -> list[Figure]:
    """In what share of so many pictures of a kind no row is reported; every crop's profile takes its turn."""
    camera = load_robot("bonnbot").cameras.front.pinhole()
    random, crops = np.random.default_rng(seed), cycle([load_crop(name) for name in CROPS])
    case, right = f"no rows: {kind}", {KNOWN: 0, UNKNOWN: 0}
    for image in range(count):
        progress(case, image, count)
        picture, crop = KINDS[kind](random), next(crops)
        right[KNOWN] += not reports_row(find(picture, crop, as_large(camera, picture)))
        right[UNKNOWN] += not reports_row(find_unposed(picture, crop).view)
    progress(case, count, count)
    return [Figure(case, metric, times / count, goal=1.0) for metric, times in right.items()]


def reports_row(view: View) -> bool:
    """Whether any row, of the lane or beside it, is reported with a confidence of at least REPORTED."""
    rows = view.lines + (view.lane.rows if view.lane else ())
    return any(row.confidence >= REPORTED for row in rows)


def as_large(camera: Pinhole, image: Image) -> Pinhole:
    """The camera as if its pictures had this one's size, its field of view no wider and no taller."""
    height, width = image.shape[:2]
    focal_px = camera.focal_px * max(width / camera.width_px, height / camera.height_px)
    return replace(camera, width_px=width, height_px=height, focal_px=focal_px)


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
    image, light = bare_soil(random), np.ones((*SHAPE, 1), np.float32)
    height, width = SHAPE
    for side in (-1, 1):
        middle = side * random.uniform(*RUT_PLACES)
        edges = np.array([middle - RUT_WIDTH / 2, middle + RUT_WIDTH / 2])
        across = np.concatenate([edges * FAR_SCALE, edges[::-1]]) + 1 / 2
        corners = np.stack([across * width, [0, 0, height, height]], axis=-1)
        cv2.fillConvexPoly(light, corners.round().astype(np.int32), RUT_BRIGHTNESS)
    return np.asarray(image * light, dtype=np.uint8)


def sky(random: np.random.Generator) -> Image:
    """Blue, paler downwards."""
    down = np.linspace(0, random.uniform(), SHAPE[0])[:, None, None]
    column = np.array(SKY_BGR) * (1 - down) + np.array(HAZE_BGR) * down
    return np.asarray(np.repeat(column, SHAPE[1], axis=1), dtype=np.uint8)


def clouds(random: np.random.Generator) -> Image:
    """White patches before the blue."""
    blur = cv2.GaussianBlur(random.standard_normal(SHAPE), (0, 0), CLOUD_PX)
    white = (blur / blur.std()).clip(0, 1)[..., None]
    return np.asarray(sky(random) * (1 - white) + FULL * white, dtype=np.uint8)


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
    return random.integers(0, random.integers(2, FULL + 1), (*SHAPE, 3), dtype=np.uint8, endpoint=True)


def gaussian_noise(random: np.random.Generator) -> Image:
    """Normally distributed about grey."""
    return _clipped(random.normal(GREY, random.uniform(0, NOISE_SIGMA), (*SHAPE, 3)))


def salt_and_pepper(random: np.random.Generator) -> Image:
    """White and black pixels on grey, each channel by itself."""
    drawn = random.uniform(0, 1, (*SHAPE, 3))
    levels = [drawn < SALT_SHARE, drawn > 1 - SALT_SHARE]
    return np.asarray(np.select(levels, [FULL, 0], GREY), dtype=np.uint8)


def compressed_noise(random: np.random.Generator) -> Image:
    """Noise after JPEG: blocks of eight pixels in rows and columns."""
    _, content = cv2.imencode(".jpg", gaussian_noise(random), [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    return np.asarray(cv2.imdecode(content, cv2.IMREAD_COLOR), dtype=np.uint8)


def odd_sizes(random: np.random.Generator) -> Image:
    """Noise in pictures far smaller, longer or taller than a camera's."""
    shape = SIZES_PX[int(random.integers(len(SIZES_PX)))]
    return random.integers(0, FULL, (*shape, 3), dtype=np.uint8, endpoint=True)


def _clipped(values: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]") -> Image:
    return np.asarray(values.clip(0, FULL), dtype=np.uint8)


KINDS: dict[str, Maker] = {
    "bare soil": bare_soil,
    "sparse small weeds": weeds(SPARSE, SMALL_M, 0.0),
    "sparse large weeds": weeds(SPARSE, LARGE_M, 0.0),
    "dense small weeds": weeds(DENSE, SMALL_M, 0.0),
    "dense large weeds": weeds(DENSE, LARGE_M, 0.0),
    "weeds in patches": weeds(DENSE, SMALL_M, 1.0),
    "headland": headland,
    "tyre tracks": tyre_tracks,
    "grass": grass,
    "sky": sky,
    "clouds": clouds,
    "black": plain((0, 0, 0)),
    "white": plain((FULL, FULL, FULL)),
    "grey": plain((GREY, GREY, GREY)),
    "green": plain(GREEN_BGR),
    "uniform noise": uniform_noise,
    "gaussian noise": gaussian_noise,
    "salt and pepper": salt_and_pepper,
    "compressed noise": compressed_noise,
    "odd sizes": odd_sizes,
}
"""What is called what; the pictures of a kind are drawn anew each time."""
