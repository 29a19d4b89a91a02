"""What is driven in `bench switching`: short lanes of every crop; the seed decides crop, side and rows."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fieldnav.evaluation.campaign_run import drive
from fieldnav.evaluation.switching_truth import Switch, switches_of
from fieldnav.messages import Side
from fieldnav.mission.simulated import Run
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, names_of, revised
from fieldnav.settings.robot import Robot

FIELD = "demo"
LENGTH_M = 6.0
RAGGED_M, SPACING_ERROR = 0.3, 0.1
"""Row ends within plus or minus this, and row distances, as a fraction, in those fields that are uneven."""
VARIANTS = 8
"""Either side, even or ragged row ends, even or uneven row distances."""


@dataclass(frozen=True, slots=True)
class SwitchRun:
    """A run of several lanes to be driven."""

    run: Run

    @property
    def title(self) -> str:
        run = self.run
        return f"{run.field.name}, {run.crop.name}, {run.side.value}, seed {run.field.seed}"


@dataclass(frozen=True, slots=True)
class Switched:
    """What a run came to; `reason` says why it did not finish."""

    wanted: SwitchRun
    switches: tuple[Switch, ...]
    attempts_wanted: int
    lanes_missed: int
    lanes_repeated: int
    run_over: int
    reason: str = ""


def switch_run(seed: int, lanes: int, robot: Robot, folder: Path) -> SwitchRun:
    """The run of a seed; any eight seeds in a row have every crop, any 64 every crop in every variant."""
    crops = names_of(Kind.CROP)
    variant = (seed // len(crops) + seed) % VARIANTS
    left, ragged, uneven = variant & 1, variant >> 1 & 1, variant >> 2
    field = _field(crops[seed % len(crops)], seed, lanes, bool(ragged), bool(uneven))
    side = Side.LEFT if left else Side.RIGHT
    return SwitchRun(Run(field, load_crop(field.crop), robot, lanes, side, folder))


def _field(crop: str, seed: int, lanes: int, ragged: bool, uneven: bool) -> FieldSettings:
    field = load_field(FIELD)
    rows: dict[str, Any] = field.rows.model_dump(mode="json")
    rows |= {"ragged_m": RAGGED_M if ragged else 0.0, "spacing_error": SPACING_ERROR if uneven else 0.0}
    changes = {"crop": crop, "seed": seed, "lanes": lanes, "length_m": LENGTH_M, "rows": rows}
    return revised(field, changes)


def drive_switches(wanted: SwitchRun) -> Switched:
    """Drive a run and judge its switches. Raises FieldnavError."""
    run = wanted.run
    done = drive(run)
    observer, truth = done.observer, done.summary.truth
    assert truth is not None, "a simulation knows its truth"
    return Switched(
        wanted=wanted,
        switches=tuple(switches_of(observer.world.plan, run.robot, run.crop.rows.spacing_m, observer.path)),
        attempts_wanted=run.lanes - 1,
        lanes_missed=truth.lanes_missed,
        lanes_repeated=truth.lanes_repeated,
        run_over=truth.crop_plants_run_over,
        reason=done.reason,
    )
