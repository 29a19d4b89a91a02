"""What a benchmark measures and reports: one row a figure, beside its goal and the best value known."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import TypeVar

Item = TypeVar("Item")


class Better(Enum):
    """Which way a figure is good."""

    HIGHER = "higher"
    LOWER = "lower"


@dataclass(frozen=True, slots=True)
class Figure:
    """One figure measured in this run.

    case: the field, crop or set; metric: its name with the unit; source: where `best_known` comes from.
    With `goal_std` a goal is reached when the deviation is no larger than that, too.
    """

    case: str
    metric: str
    value: float
    std: float | None = None
    goal: float | None = None
    best_known: float | None = None
    source: str = ""
    better: Better = Better.HIGHER
    goal_std: float | None = None

    @property
    def met(self) -> bool | None:
        """Whether the goal is reached; None for a figure without one."""
        if self.goal is None:
            return None
        if self.goal_std is not None and not (self.std is not None and self.std <= self.goal_std):
            return False
        reached = self.value >= self.goal if self.better is Better.HIGHER else self.value <= self.goal
        return bool(reached)  # a value from numpy compares to a bool that JSON does not know


@dataclass(frozen=True, slots=True)
class Plan:
    """How a benchmark is to run.

    data: the folder with the photographs, None where they are absent; quick: under a minute, for CI;
    seed: where drawn conditions begin; plots: the folder that pictures are drawn into, None for none.
    """

    data: Path | None
    quick: bool
    seed: int = 1
    plots: Path | None = None


@dataclass(frozen=True, slots=True)
class LeftOut:
    """A part of a benchmark that could not be measured, and why."""

    part: str
    reason: str


@dataclass(frozen=True, slots=True)
class Failure:
    """What went wrong in a run that was driven, and the command that drives it again."""

    case: str
    reason: str
    again: str


@dataclass(frozen=True, slots=True)
class Report:
    """Everything that one benchmark measured, what it left out, and what failed where something can."""

    figures: tuple[Figure, ...]
    left_out: tuple[LeftOut, ...] = ()
    failures: tuple[Failure, ...] | None = None


Progress = Callable[[str, int, int], None]
"""Told the part at work, how many of its steps are done, and how many there are."""


def one_by_one(part: str, items: Sequence[Item], progress: Progress) -> Iterator[Item]:
    """The items of a part one by one, progress being told before each of them and after the last."""
    for done, item in enumerate(items):
        progress(part, done, len(items))
        yield item
    progress(part, len(items), len(items))
