"""How well pairs are told apart: precision, recall and F1 of calling a row new, and their curve."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats

Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class JudgedPairs:
    """Pairs, shape (n,) each: truly two rows or not, the share that moved together, the paper's distance.

    A pair with too few features to compare has the share 0 and an infinite distance: nothing is recognised.
    """

    is_new: Flags
    share: Floats
    distance: Floats
    apart_m: Floats

    @classmethod
    def joined(cls, parts: "Iterable[JudgedPairs]") -> "JudgedPairs":
        """The pairs of several fields."""
        each = list(parts)
        return cls(
            np.concatenate([part.is_new for part in each]),
            np.concatenate([part.share for part in each]),
            np.concatenate([part.distance for part in each]),
            np.concatenate([part.apart_m for part in each]),
        )


@dataclass(frozen=True, slots=True)
class Scores:
    """Of the pairs called new: the share that are (precision); of those that are: the share so called."""

    precision: float
    recall: float

    @property
    def f1(self) -> float:
        both = self.precision + self.recall
        return 2 * self.precision * self.recall / both if both else 0.0


@dataclass(frozen=True, slots=True)
class Curve:
    """Precision and recall, shape (k,) each, at every threshold there is, the strictest first."""

    precision: Floats
    recall: Floats


def scores(called_new: Flags, is_new: Flags) -> Scores:
    """NaN precision where no pair was called new, NaN recall where none is."""
    right = float((called_new & is_new).sum())
    called, true = int(called_new.sum()), int(is_new.sum())
    return Scores(right / called if called else float("nan"), right / true if true else float("nan"))


def curve(novelty: Floats, is_new: Flags) -> Curve:
    """What a threshold on a value that rises with novelty, shape (n,), gives; equal values stay together."""
    order = np.argsort(-novelty, kind="stable")
    last = np.append(novelty[order][1:] != novelty[order][:-1], True)
    right = np.cumsum(is_new[order])[last]
    called = np.arange(1, len(order) + 1)[last]
    return Curve(right / called, right / max(int(is_new.sum()), 1))
