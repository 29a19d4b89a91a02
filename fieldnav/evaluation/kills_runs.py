"""What is driven in `bench kills`: missions of short lanes; the seed decides crop, side, rows and kills."""

from pathlib import Path
from random import Random

from fieldnav.evaluation.kills_soaked import SoakRun
from fieldnav.messages import Side
from fieldnav.settings.loading import load_crop, load_field, revised
from fieldnav.settings.robot import Robot

FIELD = "demo"
CROPS = ("sugar-beet", "potato")
"""Three rows to a lane, and two."""
LANES = 3
LENGTHS_M = (5.0, 6.0)
KILLS = (5, 8)
"""Of one mission, at least and at most; about as many as fit into it."""


def soak_run(seed: int, robot: Robot, folder: Path | None = None) -> SoakRun:
    """The mission of a seed; any four seeds in a row have both crops to both sides."""
    crop, side = CROPS[seed % 2], (Side.RIGHT, Side.LEFT)[seed // 2 % 2]
    random = Random(seed)
    changes = {"crop": crop, "seed": seed, "lanes": LANES, "length_m": random.uniform(*LENGTHS_M)}
    field = revised(load_field(FIELD), changes)
    return SoakRun(field, load_crop(crop), robot, side, random.randint(*KILLS), folder=folder)
