"""How sure a row of a comb is: a logistic regression on how well the comb, and the row itself, bear it out."""

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.comb_rows import CombRows

INTERCEPT, RESPONSE, CONTRAST, COVERAGE = -4.0, 8.0, 4.0, 3.0


def confidence_of(rows: CombRows) -> Floats:
    """Probability that each row is one, shape (rows,)."""
    score = INTERCEPT + RESPONSE * rows.response + CONTRAST * rows.contrast + COVERAGE * rows.coverage
    return np.asarray(1 / (1 + np.exp(-score)))
