"""Rows counted while the camera moves sideways, against those truly crossed: photographs and rendered steps.

Each sequence is shown forwards, backwards, with a stop, backing up on the way, and with frames dropped.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure, LeftOut, Plan, Progress, Report, one_by_one
from fieldnav.evaluation.photographs import PhotographSet
from fieldnav.evaluation.showing import Showing, order_of
from fieldnav.evaluation.sidestep_scene import SidestepScene
from fieldnav.evaluation.sideways_truth import sequences_in, true_count
from fieldnav.messages import Floats, Image, Side
from fieldnav.perception.counting.row_count import RowCount
from fieldnav.perception.counting.row_counter import RowCounter
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Robot

PART = "rows passing sideways"
RENDERED = "rendered sidesteps"
FOLDER = "seq"
WITHIN = 2  # frames between a crossing and the true one; at working speed 2 cm
GOAL_PERCENT, PERCENT = 100.0, 100.0
QUICK_STEP = 3  # times as far between rendered pictures
FIELDS = ("demo", "sim-dense-weed", "potato", "beans")
SEEDS, QUICK_SEEDS = 3, 1
ROBOT = "bonnbot"
LENGTH_M, ALONG_M, LANES = 14.0, 6.0, 2
STEP_M = 0.01  # 0.15 m/s at 15 frames/s
QUICK_SHOWN = (Showing.FORWARDS, Showing.BACK_UP)
Known = tuple[CropProfile | None, Pinhole | None]
UNKNOWN: Known = (None, None)


@dataclass(frozen=True, slots=True)
class _Judged:
    """One showing: rows counted less true, and how many of the true crossings were found in time."""

    error: int
    in_time: int
    true: int


def sideways(plan: Plan, progress: Progress) -> Report:
    """The figures of every sequence there is, and of rendered sidesteps. Raises SettingsError."""
    folder = PhotographSet.NEAR_NADIR.folder(plan, FOLDER)
    if folder is None:
        absence = LeftOut(PART, PhotographSet.NEAR_NADIR.absence(plan, FOLDER).reason)
        return Report(tuple(_rendered(plan, progress)), (absence,))
    figures, sequences = [], sequences_in(folder / FOLDER)
    for sequence in one_by_one(PART, sequences, progress):
        judged = _shown(sequence.images(), sequence.beside, UNKNOWN, tuple(Showing))
        figures += _figures(f"sideways, {sequence.name}", judged)
    left_out = () if sequences else (LeftOut(PART, f"{folder / FOLDER} holds no sequence taken sideways"),)
    return Report((*figures, *_rendered(plan, progress)), left_out)


def _rendered(plan: Plan, progress: Progress) -> list[Figure]:
    """Steps over two lanes of each field, with the camera and the crop known and without."""
    robot, seeds = load_robot(ROBOT), QUICK_SEEDS if plan.quick else SEEDS
    names, shown = (FIELDS[:1], QUICK_SHOWN) if plan.quick else (FIELDS, tuple(Showing))
    figures = []
    for name in one_by_one(RENDERED, names, progress):
        judged: dict[str, list[Mapping[Showing, _Judged]]] = {"": [], ", unknown": []}
        for seed in range(plan.seed, plan.seed + seeds):
            field = revised(load_field(name), {"lanes": LANES, "length_m": LENGTH_M, "seed": seed})
            crop = load_crop(field.crop)
            images, beside = _sidestep(field, crop, robot, STEP_M * (QUICK_STEP if plan.quick else 1))
            for case, known in {"": (crop, robot.cameras.front.pinhole()), ", unknown": UNKNOWN}.items():
                judged[case].append(_shown(images, beside, known, shown))
        for case, of_seeds in judged.items():
            figures += _of_field(f"sidestep, {name}{case}", of_seeds)
    return figures


def _sidestep(
    field: FieldSettings, crop: CropProfile, robot: Robot, step_m: float
) -> tuple[list[Image], Floats]:
    """Pictures from midway between two lanes to midway between two others, and where the rows run in them."""
    pitch_m = field.lane_pitch_m
    places_m = np.arange(-pitch_m / 2, (LANES - 1 / 2) * pitch_m, step_m)
    steps = list(SidestepScene(field, crop, robot).pictures(places_m, ALONG_M))
    return [step.image for step in steps], np.stack([step.beside_px for step in steps], axis=1)


def _shown(
    images: Sequence[Image], beside: Floats, known: Known, showings: Sequence[Showing]
) -> dict[Showing, _Judged]:
    judged = {}
    for showing in showings:
        counter, frames = RowCounter(*known), order_of(showing, len(images))
        for frame in frames:
            counter.add(images[frame])
        judged[showing] = judge(counter.result(Side.RIGHT), true_count(beside, frames, Side.RIGHT))
    return judged


def judge(counted: RowCount, true: RowCount) -> _Judged:
    """Whether the net counts agree, and for which true crossings there is one in time."""
    in_time = sum(any(abs(ours - theirs) <= WITHIN for ours in counted.frames) for theirs in true.frames)
    return _Judged(counted.rows_crossed - true.rows_crossed, in_time, len(true.frames))


def _figures(case: str, judged: Mapping[Showing, _Judged]) -> list[Figure]:
    figures = [
        Figure(
            case,
            f"rows counted wrongly, {showing.value}",
            float(abs(each.error)),
            goal=0.0,
            better=Better.LOWER,
        )
        for showing, each in judged.items()
    ]
    return [*figures, _in_time(case, list(judged.values()))]


def _of_field(case: str, of_seeds: Sequence[Mapping[Showing, _Judged]]) -> list[Figure]:
    judged = [each for of_seed in of_seeds for each in of_seed.values()]
    wrong = np.array([abs(each.error) for each in judged], float)
    mean = Figure(
        case, "rows counted wrongly, mean", float(wrong.mean()), float(wrong.std()), 0.0, better=Better.LOWER
    )
    return [mean, _in_time(case, judged)]


def _in_time(case: str, judged: Sequence[_Judged]) -> Figure:
    true = sum(each.true for each in judged)
    share = sum(each.in_time for each in judged) / true * PERCENT if true else float("nan")
    goal = GOAL_PERCENT if true else None
    return Figure(case, f"crossings within {WITHIN} frames (%)", share, goal=goal)
