"""What a round of the loop costs while it tracks: frame in to CAN frames out, early and late in a lane."""

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure
from fieldnav.evaluation.speed_rig import rigged
from fieldnav.evaluation.speed_samples import CROP, FIELD
from fieldnav.evaluation.speed_timing import MILLISECONDS
from fieldnav.messages import Floats
from fieldnav.settings.loading import load_crop, load_field, revised
from fieldnav.simulation.renderer import FieldRenderer

GOAL_MS, PERCENTILE = 15.0, 99
EARLY = 0.25  # share of the frames that is early; as many are late
LATE_GOAL = 1.1  # no growth; a tenth is how well two medians can be told apart
APPROACH_S = 12.0  # of getting to tracking, and of lane left over


def loop_figures(tracking_s: float) -> list[Figure]:
    """Frame in to CAN frames out while tracking, whether that grows, and what recording adds to it."""
    spent_ms, passed_ms = loop_ms(tracking_s)
    part = max(1, int(len(spent_ms) * EARLY))
    growth = float(np.median(spent_ms[-part:]) / np.median(spent_ms[:part]))
    worst, middle = float(np.percentile(spent_ms, PERCENTILE)), float(np.median(spent_ms))
    low = Better.LOWER
    return [
        Figure(FIELD, "frame in to CAN frame out, 99th percentile (ms)", worst, None, GOAL_MS, better=low),
        Figure(FIELD, "frame in to CAN frame out, median (ms)", middle, better=low),
        Figure(FIELD, "cost of a frame late in a lane over early", growth, None, LATE_GOAL, better=low),
        *_recorded(tracking_s, passed_ms),
    ]


def _recorded(tracking_s: float, plain_ms: Floats) -> list[Figure]:
    """The same by the clock while everything is recorded, over not recorded: waiting counts as well."""
    _, passed_ms = loop_ms(tracking_s, record=True)
    worst = float(np.percentile(passed_ms, PERCENTILE))
    over = float(np.median(passed_ms) / np.median(plain_ms))
    low = Better.LOWER
    return [
        Figure(FIELD, "the same recorded, by the clock (ms)", worst, None, GOAL_MS, better=low),
        Figure(FIELD, "a round recorded over not recorded, by the clock", over, None, LATE_GOAL, better=low),
    ]


def loop_ms(tracking_s: float, record: bool = False) -> tuple[Floats, Floats]:
    """Each round of the loop in which Tracking got a frame: processor and clock time, shape (n,) each."""
    length_m = (tracking_s + APPROACH_S) * load_crop(CROP).speeds.follow_mps
    field = revised(load_field(FIELD), {"length_m": length_m, "lanes": 1})
    with rigged(field, FieldRenderer, record=record) as rig:
        tracked = [each for each in rig.rounds(tracking_s + APPROACH_S / 2) if each.tracked]
    spent_ms = np.array([each.spent_s for each in tracked]) * MILLISECONDS
    return spent_ms, np.array([each.passed_s for each in tracked]) * MILLISECONDS
