"""Telling a new row from the same one, for every crop: rendered sidesteps behind row ends (paper IV)."""

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np

from fieldnav.evaluation.benchmark import Figure, Plan, Progress, one_by_one
from fieldnav.evaluation.recognition_pairs import NEAR_M, RowPair, balanced_pairs, looks_of
from fieldnav.evaluation.recognition_plot import draw_recognition
from fieldnav.evaluation.recognition_scene import RowEndScene
from fieldnav.evaluation.recognition_scores import Flags, JudgedPairs, Scores, scores
from fieldnav.perception.likeness import likeness
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.kinds import Kind, names_of
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised

PART = "rows told apart"
CROPS = ("sugar-beet", "coriander", "potato", "beans", "lemon-balm", "maize", "soybean", "winter-wheat")
OTHERWISE = "demo"  # the field of a crop that has none of its own
ROBOT = "bonnbot"
SEEDS, QUICK_SEEDS = 8, 1
FIRST_SEED = 1000  # the thresholds were chosen on fields of lower seeds
PICTURES, QUICK_PICTURES = 28, 16  # of one sidestep
LANES, LENGTH_M = 2, 4.0  # rows end here: more of them is not seen
MARGIN_M = 0.2  # beyond the middles of both lanes
RAGGED_M, SPACING_ERROR = 0.3, 0.1  # the hardest row ends and distances that lanes are switched over
ELEVATION_DEG, AZIMUTH_DEG = (20.0, 70.0), (-180.0, 180.0)  # of the sun
GOAL, PERCENT = 95.0, 100.0
PAPER_F1 = {"sugar-beet": 62.1}  # per cent; of no other crop a value is given
PAPER = "the paper, photographs of sugar beet, its worst crop"


def recognition_figures(plan: Plan, progress: Progress) -> list[Figure]:
    """The figures of every crop; draws precision_recall.png where the plan names a folder.

    Raises OutputError when the picture cannot be written.
    """
    seeds = [FIRST_SEED + plan.seed + number for number in range(QUICK_SEEDS if plan.quick else SEEDS)]
    judged: dict[str, list[JudgedPairs]] = {name: [] for name in CROPS}
    for name, seed in one_by_one(PART, list(product(CROPS, seeds)), progress):
        count = QUICK_PICTURES if plan.quick else PICTURES
        judged[name].append(judge(row_pairs(name, seed, count), load_crop(name)))
    if plan.plots is not None:
        draw_recognition(plan.plots, _joined(judged), {name: load_crop(name).recognition for name in CROPS})
    return [figure for name, of_seeds in judged.items() for figure in crop_figures(load_crop(name), of_seeds)]


def row_pairs(crop_name: str, seed: int, pictures: int) -> list[RowPair]:
    """Labelled pairs from one sidestep over one field; every other seed goes to the left."""
    crop, random = load_crop(crop_name), np.random.default_rng(seed)
    scene = RowEndScene(_field(crop_name, seed, random), crop, load_robot(ROBOT))
    ends_m = (-MARGIN_M, float(np.ptp(scene.plan.rows.lane_n_m)) + MARGIN_M)
    places_m = np.sort(random.uniform(*ends_m, pictures))
    seen = scene.pictures(places_m[::-1] if seed % 2 else places_m)
    return balanced_pairs([looks_of(picture, crop, scene.camera) for picture in seen], random)


def judge(pairs: Sequence[RowPair], crop: CropProfile) -> JudgedPairs:
    """What perception says of pairs."""
    said = [likeness(pair.reference.features, pair.candidate.features, crop) for pair in pairs]
    return JudgedPairs(
        np.array([pair.is_new for pair in pairs], bool),
        np.array([each.share if each else 0.0 for each in said], float),
        np.array([each.distance if each else np.inf for each in said], float),
        np.array([pair.apart_m for pair in pairs], float),
    )


def crop_figures(crop: CropProfile, of_seeds: Sequence[JudgedPairs]) -> list[Figure]:
    """The figures of one crop: at the shipped threshold, and beside them the paper's measure at its own."""
    pairs = JudgedPairs.joined(of_seeds)
    ours = scores(_called_new(pairs, crop), pairs.is_new)
    spread = float(np.std([scores(_called_new(each, crop), each.is_new).f1 for each in of_seeds])) * PERCENT
    best_known = PAPER_F1.get(crop.name)
    case, source = f"rows told apart, {crop.name}", PAPER if best_known else ""
    known_again = ~_called_new(pairs, crop) & ~pairs.is_new
    near = ~pairs.is_new & (pairs.apart_m <= NEAR_M[1])
    return [
        Figure(case, "new row or the same, F1 (%)", ours.f1 * PERCENT, spread, GOAL, best_known, source),
        Figure(case, "precision (%)", ours.precision * PERCENT),
        Figure(case, "recall (%)", ours.recall * PERCENT),
        Figure(case, "same row known again within 15 cm (%)", _share(known_again, near)),
        Figure(case, "F1 by the paper's measure (%)", _by_paper(pairs, crop).f1 * PERCENT),
    ]


def _called_new(pairs: JudgedPairs, crop: CropProfile) -> Flags:
    return pairs.share < crop.recognition.new_row_share


def _by_paper(pairs: JudgedPairs, crop: CropProfile) -> Scores:
    return scores(pairs.distance > crop.recognition.new_row_distance, pairs.is_new)


def _share(of: Flags, among: Flags) -> float:
    return float(of[among].mean()) * PERCENT if among.any() else float("nan")


def _joined(judged: Mapping[str, Sequence[JudgedPairs]]) -> dict[str, JudgedPairs]:
    return {name: JudgedPairs.joined(of_seeds) for name, of_seeds in judged.items()}


def _field(crop_name: str, seed: int, random: np.random.Generator) -> FieldSettings:
    """The crop's own field where it has one, short, its row ends ragged, under a sun drawn anew."""
    field = load_field(crop_name if crop_name in names_of(Kind.FIELD) else OTHERWISE)
    sun = {
        "sun_elevation_deg": random.uniform(*ELEVATION_DEG),
        "sun_azimuth_deg": random.uniform(*AZIMUTH_DEG),
        "sunshine": random.uniform(),
    }
    rows = field.rows.model_dump(mode="json") | {"ragged_m": RAGGED_M, "spacing_error": SPACING_ERROR}
    size = {"crop": crop_name, "lanes": LANES, "length_m": LENGTH_M}
    return revised(field, {**size, "seed": seed, "rows": rows, "light": sun})
