"""Pictures without a crop row, made here, and the share of them in which perception rightly reports none."""

from dataclasses import replace
from itertools import cycle

import numpy as np

from fieldnav.evaluation.benchmark import Figure, Plan, Progress, one_by_one
from fieldnav.evaluation.found_rows import LEAST_CONFIDENCE
from fieldnav.evaluation.rendered_rows import CROPS
from fieldnav.evaluation.rowless_pictures import (
    BRIGHTEST,
    GREY,
    Maker,
    clouds,
    compressed_noise,
    gaussian_noise,
    grass,
    odd_sizes,
    plain,
    salt_and_pepper,
    sky,
    uniform_noise,
)
from fieldnav.evaluation.rowless_plots import bare_soil, headland, tyre_tracks, weeds
from fieldnav.messages import Image
from fieldnav.perception.perceive import View, find
from fieldnav.perception.unposed import find_unposed
from fieldnav.pinhole import Pinhole
from fieldnav.settings.loading import load_crop, load_robot

IMAGES, QUICK_IMAGES = 9, 2  # of each kind
KNOWN = "pictures without a row reported (share)"
UNKNOWN = "pictures without a row reported, camera not known (share)"
ROBOT = "bonnbot"
SMALL_M, LARGE_M = (0.02, 0.05), (0.08, 0.20)  # diameter of weeds
SPARSE, DENSE = (2.0, 20.0), (20.0, 60.0)  # weeds to a square metre
GREEN_BGR = (40, 160, 60)

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
    "white": plain((BRIGHTEST, BRIGHTEST, BRIGHTEST)),
    "grey": plain((GREY, GREY, GREY)),
    "green": plain(GREEN_BGR),
    "uniform noise": uniform_noise,
    "gaussian noise": gaussian_noise,
    "salt and pepper": salt_and_pepper,
    "compressed noise": compressed_noise,
    "odd sizes": odd_sizes,
}
"""What is called what; the pictures of a kind are drawn anew each time."""


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
    camera = load_robot(ROBOT).cameras.front.pinhole()
    random, crops = np.random.default_rng(seed), cycle([load_crop(name) for name in CROPS])
    case, right = f"no rows: {kind}", {KNOWN: 0, UNKNOWN: 0}
    for _ in one_by_one(case, range(count), progress):
        picture, crop = KINDS[kind](random), next(crops)
        right[KNOWN] += not reports_row(find(picture, crop, as_large(camera, picture)))
        right[UNKNOWN] += not reports_row(find_unposed(picture, crop).view)
    return [Figure(case, metric, times / count, goal=1.0) for metric, times in right.items()]


def reports_row(view: View) -> bool:
    """Whether any row, of the lane or beside it, is reported with at least LEAST_CONFIDENCE."""
    rows = view.lines + (view.lane.rows if view.lane else ())
    return any(row.confidence >= LEAST_CONFIDENCE for row in rows)


def as_large(camera: Pinhole, image: Image) -> Pinhole:
    """The camera as if its pictures had this one's size, its field of view no wider and no taller."""
    height, width = image.shape[:2]
    focal_px = camera.focal_px * max(width / camera.width_px, height / camera.height_px)
    return replace(camera, width_px=width, height_px=height, focal_px=focal_px)
