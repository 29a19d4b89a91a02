"""How sure the rows of a comb are: a logistic regression on how well the comb, and each row, are borne out.

Fitted to rows found in photographs and rendered frames, with and without the camera known, against their
ground truth, and to what is found where there is none: weeds, grass, soil, noise, photographs on their side.
The benchmark of detection draws the reliability of the result.
"""

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.comb.bands import Bands
from fieldnav.perception.comb.row_comb import RowComb
from fieldnav.perception.comb.rows import CombRows

INTERCEPT = -10.4
RESPONSE = 18.25  # of the comb's correlation with the vegetation
WEAKEST = 12.33  # of that in the two weakest of six stretches
EVENNESS = 4.65  # of how evenly vegetation stands along the row itself
LEAST_STAND = 0.2  # of the middle row's vegetation: less is no row, however well it would fit in


def confidence_of(rows: CombRows, comb: RowComb, bands: Bands) -> Floats:
    """The probability that each row is one, shape (rows,)."""
    whole = RESPONSE * comb.response(bands) + WEAKEST * comb.weakest_response(bands)
    likely = 1 / (1 + np.exp(-(INTERCEPT + whole + EVENNESS * rows.evenness)))
    return np.asarray(likely * np.minimum(rows.stand / LEAST_STAND, 1))
