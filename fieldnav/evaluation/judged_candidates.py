"""The candidates of one picture, what both witnesses say of them, and what is true of them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fieldnav.evaluation.near_nadir import ALIKE_DEG
from fieldnav.messages import Floats, Image
from fieldnav.perception.comb.candidates import candidates_in
from fieldnav.perception.comb.row_judge import CandidateMeasures, measure
from fieldnav.perception.comb.search_range import any_camera
from fieldnav.perception.row_network import look
from fieldnav.perception.vegetation import vegetation_of
from fieldnav.settings.crop import Vegetation

ALIKE_WORTH = 0.3
"""Of the worth of rows, that their right direction counts."""


@dataclass(frozen=True, slots=True)
class JudgedCandidate:
    """One candidate of a picture.

    features: shape (features,); row_features: shape (rows, features), with 0 for the candidate's log odds;
    worth: 0 for rows that are none to 1 for all rows and no other; right: shape (rows,), 1 and 0 for rows
    that are there or not, NaN for one that nobody can say this of.
    """

    features: Floats
    row_features: Floats
    worth: float
    right: Floats


JudgedPicture = Sequence[JudgedCandidate]
"""All candidates of one picture; there may be none."""
Truth = Callable[[CandidateMeasures], tuple[float, Floats]]
"""What a candidate is worth, and which of its rows are right, as in JudgedCandidate."""


def judged_picture(image: Image, truth: Truth) -> JudgedPicture:
    """Every candidate of a picture, of a camera and a crop that nobody knows."""
    vegetation = Vegetation()
    cover, heat = vegetation_of(image, vegetation), look(image)
    candidates = candidates_in(image, cover, heat, any_camera(None), vegetation)
    return [
        JudgedCandidate(measured.features(), measured.row_features(0.0), *truth(measured))
        for measured in measure(candidates, cover, heat)
    ]


def worth_of(right: Floats, must_be_found: int, turned_deg: Floats) -> float:
    """The harmonic mean of precision and recall, less where rows that are right have a wrong direction.

    right: as in JudgedCandidate; must_be_found: how many rows; turned_deg: shape (n,), of the right rows.
    """
    hits, wrong = int((right == 1).sum()), int((right == 0).sum())
    alike = float(np.mean(turned_deg < ALIKE_DEG)) if len(turned_deg) else 0.0
    f1 = 2 * hits / max(hits + wrong + must_be_found, 1)
    return min(f1, 1.0) * (1 - ALIKE_WORTH * (1 - alike))
