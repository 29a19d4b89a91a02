"""Rows that vegetation and the network bear out together, in any picture: the best of many candidates."""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Floats, Image, RowLine
from fieldnav.perception.comb.candidates import Candidate, candidates_in
from fieldnav.perception.comb.periodogram import SearchRange
from fieldnav.perception.comb.row_judge import choose_rows, measure, row_judge
from fieldnav.perception.found import NO_ROWS, Found
from fieldnav.perception.row_network import look
from fieldnav.perception.vegetation import Cover, as_colour
from fieldnav.settings.crop import Vegetation


@dataclass(frozen=True, slots=True)
class Witnessed:
    """The rows of a picture, sure or not, and the candidate that they are; None where there was none.

    field: the probability that the picture shows a field of rows at all; 0 for what is no picture.
    """

    found: Found
    candidate: Candidate | None
    field: float


def find_witnessed(image: Image, cover: Cover, vegetation: Vegetation, tried: SearchRange) -> Witnessed:
    """Look for rows without knowing the camera's pose; tried: combs of vegetation that are likely."""
    colour = as_colour(image)
    if colour is None:
        return Witnessed(NO_ROWS, None, 0.0)
    heat = look(colour)
    candidates = candidates_in(colour, cover, heat, tried, vegetation)
    chosen = choose_rows(measure(candidates, cover, heat), row_judge())
    if chosen is None:
        return Witnessed(NO_ROWS, None, heat.field)
    lines = lines_of(chosen.candidate, chosen.confidence, cover.height_px)
    return Witnessed(Found(lines, chosen.candidate.paths_px), chosen.candidate, heat.field)


def lines_of(candidate: Candidate, confidence: Floats, height_px: int) -> tuple[RowLine, ...]:
    """The straight line nearest to each row of a candidate; the near ground, drawn larger, counts more."""
    lines = []
    for path, sure in zip(candidate.paths_px, confidence, strict=True):
        down = path[:, 1] / (height_px - 1)
        weight = np.maximum(1 + candidate.convergence * (down - 1 / 2), 0.0)
        basis = np.stack([1 - down, down], axis=-1)
        top, bottom = np.linalg.lstsq(basis * weight[:, None], path[:, 0] * weight, rcond=None)[0]
        lines.append(RowLine(float(top), float(bottom), float(sure)))
    return tuple(lines)
