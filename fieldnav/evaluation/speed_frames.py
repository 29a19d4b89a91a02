"""What a frame costs: finding and tracking rows, over the least that any finder of plants does with it."""

from collections.abc import Sequence
from itertools import count

import cv2
import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure, Plan
from fieldnav.evaluation.near_nadir import profile_of
from fieldnav.evaluation.near_nadir_truth import photographs_in
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.speed_samples import (
    CROP,
    FIELD,
    ROBOT,
    Sample,
    crowded_sample,
    rendered_sample,
    strewn_sample,
)
from fieldnav.evaluation.speed_timing import Work, medians_ms
from fieldnav.messages import CameraName, Direction, Floats, Frame, Image, Side
from fieldnav.odometry import Pose
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.lane import LaneFit, comb_m
from fieldnav.perception.perceive import find
from fieldnav.perception.plants import find_plants
from fieldnav.perception.row_network import look
from fieldnav.perception.second_witness import by_vegetation_alone
from fieldnav.settings.loading import load_crop, load_robot
from states.behaviour import Task
from states.guides import guide_for

PHOTOGRAPH_ROUNDS, QUICK_PHOTOGRAPH_ROUNDS = 15, 3  # of each photograph
FRESH_GOAL, TRACKING_GOAL = 1.5, 1.0  # over the bare primitives
LOOK_GOAL_MS = 20.0  # of the network, beside a fresh frame
REFERENCE_FRESH_MS, REFERENCE_TRACKING_MS = 57.0, 17.0
REFERENCE = "reference implementation, the least of its range on a machine like this"
STREWN = (50, 120, 200, 300, 400, 500)  # plants in view
FRAME_STEP_M = 0.033  # 0.5 m/s at 15 frames/s
BRIGHTEST = 255


def bare_primitives(image: Image) -> object:
    """The least that any finder of plants does at full resolution: excess green, Otsu, connected regions."""
    blue, green, red = cv2.split(image)
    excess = cv2.subtract(green, cv2.addWeighted(red, 1 / 2, blue, 1 / 2, 0))
    _, mask = cv2.threshold(excess, 0, BRIGHTEST, cv2.THRESH_OTSU)
    return cv2.connectedComponentsWithStats(mask)


def tracking_in(sample: Sample) -> Work:
    """Tracking in the frames that follow, as the robot drives on, of a lane straight under it."""
    image, crop, camera = sample.image, sample.crop, sample.camera
    guide = guide_for(Task(crop, dict.fromkeys(CameraName, camera), Side.RIGHT, 1), Direction.FORWARD)
    plane, frame = canopy_plane(camera, crop), Frame(CameraName.FRONT, 1, 0.0, image)
    rows = tuple(plane.row_in_image(place, 0.0) for place in comb_m(crop))
    guide.begin(LaneFit(rows, 0.0, 0.0, len(rows), crop.rows.spacing_m, 0.0), frame, Pose())
    steps = count(1)

    def work() -> object:
        centres = find_plants(image, crop.vegetation, camera)
        return guide.look(frame, centres, Pose(x_m=next(steps) * FRAME_STEP_M))

    return work


def frame_ms(sample: Sample, rounds: int) -> Floats:
    """Milliseconds of bare primitives, of a fresh frame by vegetation alone, of tracking, shape (3,)."""
    image, crop, camera = sample.image, sample.crop, sample.camera
    alone = by_vegetation_alone(crop)
    works = (lambda: bare_primitives(image), lambda: find(image, alone, camera), tracking_in(sample))
    return medians_ms(works, rounds)


def frame_figures(plan: Plan, rounds: int) -> list[Figure]:
    """Fresh frames and tracked ones against the bare primitives: rendered, and photographs where given.

    rounds: of each rendered picture.
    """
    crowded, usual = crowded_sample(), rendered_sample(FIELD, load_crop(CROP))
    plants = len(find_plants(crowded.image, crowded.crop.vegetation, crowded.camera))
    figures = [Figure("250 plants", "plants in view", plants)]
    figures += _cost_figures("250 plants", [crowded], rounds) + _cost_figures(FIELD, [usual], rounds)
    (look_ms,) = medians_ms((lambda: look(usual.image),), rounds)
    figures.append(
        Figure(FIELD, "second witness (ms)", float(look_ms), None, LOOK_GOAL_MS, better=Better.LOWER)
    )
    folder = PhotographSet.NEAR_NADIR.folder(plan)
    if folder is not None:
        camera = load_robot(ROBOT).cameras.front.pinhole()
        photographed = [
            Sample(read_photograph(each.path), profile_of(each.crop) or load_crop(CROP), camera)
            for each in photographs_in(folder)
        ]
        rounds = QUICK_PHOTOGRAPH_ROUNDS if plan.quick else PHOTOGRAPH_ROUNDS
        figures += _cost_figures("photographs", photographed, rounds)
    return figures


def _cost_figures(case: str, samples: Sequence[Sample], rounds: int) -> list[Figure]:
    """Mean over pictures of each one's medians and ratios."""
    spent_ms = np.array([frame_ms(sample, rounds) for sample in samples])
    ratio = spent_ms[:, 1:] / spent_ms[:, :1]
    bare, fresh, tracked = (_spread(column) for column in spent_ms.T)
    over = [_spread(column) for column in ratio.T]
    low = Better.LOWER
    return [
        Figure(case, "fresh frame over bare primitives", *over[0], FRESH_GOAL, better=low),
        Figure(case, "tracking over bare primitives", *over[1], TRACKING_GOAL, better=low),
        Figure(case, "bare primitives (ms)", *bare, better=low),
        Figure(case, "fresh frame (ms)", *fresh, None, REFERENCE_FRESH_MS, REFERENCE, low),
        Figure(case, "tracking (ms)", *tracked, None, REFERENCE_TRACKING_MS, REFERENCE, low),
    ]


def _spread(values: Floats) -> tuple[float, float | None]:
    return float(values.mean()), float(values.std()) if len(values) > 1 else None


def crowd_figures(rounds: int) -> list[Figure]:
    """The cost of a plant among many over that among few, by a parabola through all the pictures' costs."""
    samples = [strewn_sample(count) for count in STREWN]
    plants = np.array([len(find_plants(s.image, s.crop.vegetation, s.camera)) for s in samples], float)
    spent_ms = np.array([frame_ms(sample, rounds)[1:] for sample in samples])
    ends = np.array([STREWN[0], STREWN[-1]], float)
    figures = []
    for part, column in zip(("fresh frame", "tracking"), spent_ms.T, strict=True):
        few_ms, many_ms = np.polyval(np.polyfit(plants, column, 2), ends) / ends
        metric = f"{part}, cost a plant with {STREWN[-1]} in view over with {STREWN[0]}"
        figures.append(Figure("plants in view", metric, many_ms / few_ms, goal=1.0, better=Better.LOWER))
    return figures
