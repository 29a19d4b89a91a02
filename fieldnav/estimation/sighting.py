"""What the plants of one frame say of the lane: residuals weighed into information."""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats

SHAKE_M = 0.02  # standard deviation by which roll moves a whole frame sideways: a degree, a metre up
HUBER = 1.5  # residuals beyond so many standard deviations count linearly


@dataclass(frozen=True, slots=True)
class Sighting:
    """Plants in the frame of the robot that travels, x ahead, y left.

    position_m: shape (m, 2); reach_m: how far from its row each may stand, shape (m,); weight: shape (m,),
    1 for a whole plant.
    """

    position_m: Floats
    reach_m: Floats
    weight: Floats


def information(
    design: Floats, off_m: Floats, weight: Floats, covariance: Floats, scatter_m: float, new: float
) -> tuple[Floats, Floats]:
    """Information matrix, shape (k, k), and vector, shape (k,), of plants `off_m` left of their rows.

    design: shape (m, k), how each residual changes with the state, of that covariance; scatter_m: standard
    deviation of a whole plant from its row; new: the share of the plants that earlier frames did not show,
    for many looks at a plant are one plant's word.
    """
    expected = np.einsum("ij,jk,ik->i", design, covariance, design)
    spread_m = np.sqrt(scatter_m**2 / weight + SHAKE_M**2 + expected)
    away = np.abs(off_m) / spread_m
    trust = new * np.minimum(1.0, HUBER / np.maximum(away, HUBER)) * weight / scatter_m**2
    # Roll moves all plants of a frame alike: what they have in common says the less (Woodbury's identity).
    common = design.T @ trust
    total = float(trust.sum()) + SHAKE_M**-2
    told = (design.T * trust) @ design - np.outer(common, common) / total
    return told, design.T @ (trust * off_m) - common * float(trust @ off_m) / total
