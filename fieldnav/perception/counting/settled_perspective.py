"""The perspective of a camera that stays what it is, settled by the rows of many frames."""

from dataclasses import replace

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.comb.bands import bands_of
from fieldnav.perception.comb.finder import find_comb
from fieldnav.perception.comb.periodogram import SearchRange
from fieldnav.perception.comb.search_range import any_camera, range_of
from fieldnav.perception.counting.levelled import Perspective, perspective_of
from fieldnav.perception.vegetation import Cover
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

MOST_FRAMES = 16  # that are searched for rows; more change nothing and cost time
TRUST = 4  # power of the response by which a frame weighs: where rows are shown badly, their lean is chance
MIN_RESPONSE = 0.01  # so that some frame weighs something where none shows rows
FIRST = Perspective(0.4, 0.0, 0.3)
"""Until rows are found: a camera that looks down steeply, and three rows."""
FLATTEST, STEEPEST = 0.02, 2.2  # convergence, as far as rows are searched for


class SettledPerspective:
    """The median over the frames looked at so far, weighted by how well each one's rows explain it.

    camera: at the size of the frames, None where it is not known; the crop may be unknown too.
    """

    def __init__(self, crop: CropProfile | None, camera: Pinhole | None) -> None:
        self._convergence = None if camera is None else _convergence(camera)
        self._tried = _tried(crop, camera, self._convergence)
        self._found: list[tuple[Perspective, float]] = []
        self.now = replace(FIRST, convergence=self._convergence or FIRST.convergence)

    def look(self, cover: Cover) -> None:
        """Take in the rows of a frame that shows other ground than those before."""
        bands = bands_of(cover.strength)
        comb = find_comb(bands, self._tried) if len(self._found) < MOST_FRAMES else None
        if comb is None:
            return
        self._found.append((perspective_of(comb), max(comb.response(bands), MIN_RESPONSE) ** TRUST))
        each = np.array([(one.convergence, one.vanishing, one.spacing) for one, _ in self._found])
        convergence, vanishing, spacing = _median(each, np.array([weight for _, weight in self._found]))
        settled = self._convergence or float(np.clip(convergence, FLATTEST, STEEPEST))
        self.now = Perspective(settled, float(vanishing), float(spacing))


def _median(values: Floats, weight: Floats) -> Floats:
    """The weighted median of each column of values, shape (n, k); weight: shape (n,)."""
    order = values.argsort(axis=0)
    below = weight[order].cumsum(axis=0)
    middle = (below >= weight.sum() / 2).argmax(axis=0)
    return np.asarray(np.take_along_axis(values, np.take_along_axis(order, middle[None], 0), 0)[0])


def _convergence(camera: Pinhole) -> float:
    return float(np.clip(camera.height_px / (camera.focal_px * np.tan(camera.tilt_rad)), FLATTEST, STEEPEST))


def _tried(crop: CropProfile | None, camera: Pinhole | None, convergence: float | None) -> SearchRange:
    if camera is None or convergence is None:
        return any_camera(crop.rows.spacing_m if crop else None)
    if crop is None:
        return replace(any_camera(None), convergence=np.array([convergence]))
    return range_of(canopy_plane(camera, crop), crop.rows.spacing_m, pose_known=True)
