"""The paper's detection protocol on rendered pictures: rows found against the rows as sown (paper IV-B)."""

from collections.abc import Iterable
from math import radians

import numpy as np
from scipy.optimize import linear_sum_assignment

from fieldnav.evaluation.benchmark import Figure, Plan, Progress, one_by_one
from fieldnav.evaluation.found_rows import with_method
from fieldnav.evaluation.rendered_scene import Scene, Shot
from fieldnav.messages import Floats, RowLine, Side
from fieldnav.perception.perceive import find
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, RowFinder
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_field, revised
from fieldnav.simulation.plan import sow

CROPS = ("beans", "potato", "coriander", "sugar-beet", "lemon-balm")
SIMULATED = ("sim-curved", "sim-large-gaps", "sim-dense-weed")
IMAGES, QUICK_IMAGES = 100, 10  # of each field; the paper had 100
IMAGES_A_SEED = 10  # pictures of one sown field under one sun
LONGEST_FIELD_M = 40.0  # one whole bend of the curved field; more would only cost time
TILT_DEG = (55.0, 75.0)  # paper
ELEVATION_DEG, AZIMUTH_DEG = (20.0, 70.0), (-180.0, 180.0)  # of the sun; lower than 20 it is dusk
WIDE_DEG, NARROW_DEG = 11.0, 2.0  # paper's threshold for an orientation, and ours
POSITION_GOAL, WIDE_GOAL, NARROW_GOAL = 98.0, 99.5, 95.0  # per cent
PAPER_POSITION, PAPER_WIDE = 88.1, 88.3  # per cent
PAPER = "the paper, photographs of five real crops together"
PERCENT = 100.0


def score(truth: Iterable[RowLine], found: Iterable[RowLine], camera: Pinhole) -> Floats:
    """Per true row: position accuracy, and whether its angle is right within WIDE_DEG and NARROW_DEG.

    Shape (rows, 3), per cent. Each row found stands for one true row at most, the pairs being those that lie
    nearest together; a true row left over is missed and scores 0.
    """
    true, near = (
        np.array([(r.x_top_px, r.x_bottom_px) for r in rows]).reshape(-1, 2) for rows in (truth, found)
    )
    scored = np.zeros((len(true), 3))
    apart_px = np.abs(true[:, None] - near[None, :]).mean(axis=-1)
    mine, theirs = linear_sum_assignment(apart_px)
    off_px = np.abs(true[mine, 1] - near[theirs, 1])
    angles = [np.degrees(np.arctan2(ends[:, 0] - ends[:, 1], camera.height_px - 1)) for ends in (true, near)]
    off_deg = np.abs(angles[0][mine] - angles[1][theirs])
    accuracy = (1 - off_px / camera.width_px).clip(0)
    scored[mine] = np.stack([accuracy, off_deg <= WIDE_DEG, off_deg <= NARROW_DEG], axis=-1) * PERCENT
    return scored


def rendered_rows(plan: Plan, progress: Progress) -> list[Figure]:
    """The figures of every crop and simulated field, by each method of finding rows."""
    count = QUICK_IMAGES if plan.quick else IMAGES
    figures = []
    for name in CROPS + SIMULATED:
        figures += field_figures(load_field(name), count, plan.seed, progress)
    return figures


def field_figures(field: FieldSettings, count: int, seed: int, progress: Progress) -> list[Figure]:
    """Three figures of one field for each method, from so many pictures; fields are sown from `seed` on."""
    crop, random = load_crop(field.crop), np.random.default_rng(seed)
    usual = crop.finding.method
    methods = sorted(RowFinder, key=lambda method: method is not usual)
    scores: dict[RowFinder, list[Floats]] = {method: [] for method in methods}
    for image in one_by_one(field.name, range(count), progress):
        if image % IMAGES_A_SEED == 0:
            scene = _sown(field, crop, seed + image // IMAGES_A_SEED, random)
        shot = scene.shoot(scene.random_place(random), radians(random.uniform(*TILT_DEG)), random)
        for method, so_far in scores.items():
            so_far.append(score(shot.truth, lane_found(shot, with_method(crop, method)), shot.camera))
    figures = []
    for method, scored in scores.items():
        figures += _figures(field.name, np.concatenate(scored), method, usual)
    return figures


def _sown(field: FieldSettings, crop: CropProfile, seed: int, random: np.random.Generator) -> Scene:
    """The field sown from a seed, under a sun of its own."""
    sun = {
        "sun_elevation_deg": random.uniform(*ELEVATION_DEG),
        "sun_azimuth_deg": random.uniform(*AZIMUTH_DEG),
        "sunshine": random.uniform(),
    }
    changes = {"seed": seed, "light": sun, "length_m": min(field.length_m, LONGEST_FIELD_M)}
    changed = revised(field, changes)
    return Scene(changed, crop, sow(changed, crop, Side.RIGHT))


def lane_found(shot: Shot, crop: CropProfile) -> list[RowLine]:
    """The rows of the lane that perception sees in a picture; those it only fills in are none.

    Where it sees no lane: every row that the finder reports.
    """
    view = find(shot.image, crop, shot.camera)
    if view.lane is None:
        return list(view.lines)
    return [row for row in view.lane.rows if row.confidence > 0]


def _figures(name: str, scored: Floats, method: RowFinder, usual: RowFinder) -> list[Figure]:
    """The three figures of a field; the goals are asked of the method that its profile names."""
    asked = method is usual
    case = name if asked else f"{name} ({method.value.replace('_', ' ')})"
    position, wide, narrow = scored.mean(axis=0)
    goals = (POSITION_GOAL, WIDE_GOAL, NARROW_GOAL) if asked else (None, None, None)
    spread = float(scored[:, 0].std())
    return [
        Figure(case, "position accuracy (%)", float(position), spread, goals[0], PAPER_POSITION, PAPER),
        Figure(case, f"rows within {WIDE_DEG:g} degrees (%)", float(wide), None, goals[1], PAPER_WIDE, PAPER),
        Figure(case, f"rows within {NARROW_DEG:g} degrees (%)", float(narrow), None, goals[2]),
    ]
