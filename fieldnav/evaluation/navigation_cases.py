"""What `bench navigation` drives: the paper's fields and two hard ones, with the goals of each."""

from dataclasses import dataclass
from typing import Any

from fieldnav.errors import SettingsError
from fieldnav.settings.field import ALL_ROWS, FieldSettings
from fieldnav.settings.loading import load_field, revised

HARD_FIELD = "sugar-beet"
HALF = 0.5


@dataclass(frozen=True, slots=True)
class Spread:
    """A mean and the standard deviation about it."""

    mean: float
    std: float


@dataclass(frozen=True, slots=True)
class Errors:
    """Distance from the lane's centre line, cm, and angle to it, degrees."""

    distance_cm: Spread
    angle_deg: Spread


def _errors(distance: float, its_std: float, angle: float, of_angle: float) -> Errors:
    return Errors(Spread(distance, its_std), Spread(angle, of_angle))


@dataclass(frozen=True, slots=True)
class Case:
    """A lane to be driven; `gap_m` is an empty stretch of a row, or of all, half way along it.

    paper: what the paper reports of it, None for what it did not drive; `measured` says where.
    """

    name: str
    field: str
    goal: Errors
    paper: Errors | None = None
    measured: str = ""
    gap_m: float = 0.0
    gap_row: int = ALL_ROWS


SIMULATED, IN_FIELD = "paper, simulation", "paper, field"

CASES = (
    Case(
        "sim-curved",
        "sim-curved",
        _errors(1.2, 0.9, 0.8, 0.6),
        _errors(9.01, 2.63, 4.52, 3.52),
        SIMULATED,
    ),
    Case(
        "sim-large-gaps",
        "sim-large-gaps",
        _errors(1.2, 0.9, 0.6, 0.5),
        _errors(6.75, 3.15, 4.76, 2.69),
        SIMULATED,
    ),
    Case(
        "sim-dense-weed",
        "sim-dense-weed",
        _errors(1.0, 0.8, 0.6, 0.5),
        _errors(7.41, 2.86, 3.91, 1.73),
        SIMULATED,
    ),
    Case("beans", "beans", _errors(0.9, 0.7, 0.6, 0.5), _errors(3.49, 2.89, 3.73, 3.21), IN_FIELD),
    Case("potato", "potato", _errors(0.8, 0.6, 0.6, 0.5), _errors(2.18, 3.01, 4.91, 1.63), IN_FIELD),
    Case("coriander", "coriander", _errors(0.8, 0.6, 0.6, 0.5), _errors(2.91, 2.38, 2.57, 1.05), IN_FIELD),
    Case("sugar-beet", HARD_FIELD, _errors(1.0, 0.8, 0.6, 0.5), _errors(8.41, 3.79, 3.25, 1.27), IN_FIELD),
    Case("lemon-balm", "lemon-balm", _errors(0.8, 0.6, 0.6, 0.5), _errors(2.12, 1.58, 3.21, 2.83), IN_FIELD),
    Case("sugar-beet, one row missing for 5 m", HARD_FIELD, _errors(1.0, 0.8, 0.6, 0.5), gap_m=5, gap_row=1),
    Case("sugar-beet, all rows missing for 2 m", HARD_FIELD, _errors(1.0, 0.8, 0.6, 0.5), gap_m=2),
)
FIELDS = tuple(dict.fromkeys(case.field for case in CASES))
"""What --fields chooses from; the hard cases go with their field."""


def cases_of(fields: tuple[str, ...]) -> tuple[Case, ...]:
    """The cases of the named fields, all for none. Raises SettingsError."""
    for name in fields:
        if name not in FIELDS:
            raise SettingsError(f"--fields {name}: unknown; allowed are {', '.join(FIELDS)}")
    return tuple(case for case in CASES if not fields or case.field in fields)


def lane_of(case: Case, length_m: float | None, seed: int) -> FieldSettings:
    """The case's field with its one lane, as long as the paper's where no length is given.

    Raises SettingsError.
    """
    changes: dict[str, Any] = {"lanes": 1, "seed": seed}
    if length_m is not None:
        changes["length_m"] = length_m
    field = revised(load_field(case.field), changes, label="", called={"length_m": "--length"})
    if not case.gap_m:
        return field
    start_m = max(0.0, HALF * (field.length_m - case.gap_m))
    gap = {"lane": 1, "row": case.gap_row, "start_m": start_m, "length_m": case.gap_m}
    return revised(field, {"gaps": field.gaps.model_dump(mode="json") | {"placed": [gap]}})


def fits(case: Case, length_m: float | None) -> bool:
    """Whether a lane so long has as much crop about the case's gap as the gap is long."""
    return length_m is None or length_m >= 2 * case.gap_m
