"""A least-squares line through the plants of every position of the sliding window (paper III-A.2)."""

from dataclasses import dataclass

import numpy as np

from fieldnav.messages import Centres, Floats
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import Finding

FEWEST_CENTRES = 2  # a line needs
FLATTEST_RAD = np.pi / 3  # from the vertical; a line flatter than this is drawn by chance, not by a row
SMALLEST_SPREAD = 0.01  # rms distance of the centres along the image's height, over that height


@dataclass(frozen=True, slots=True)
class WindowLines:
    """The lines of the window's positions from left to right, each array of shape (n,).

    A position without a line has NaN. slope: change of x with y; bottom_px: where the line meets the bottom
    edge; centres: how many plants lay in the window.
    """

    bottom_px: Floats
    slope: Floats
    centres: Floats


def window_lines(centres: Centres, finding: Finding, camera: Pinhole) -> WindowLines:
    """Slide a window of full height over the image and fit x = slope y + x0 to the plants in it.

    The positions lie symmetrically about the image's centre, so a mirrored image has mirrored lines. A plant
    weighs as its diameter. Lines that miss the image's bottom edge are left out.
    """
    middles = _middles(finding, camera)
    half_px = finding.window * camera.width_px / 2
    order = np.argsort(centres.position_px[:, 0], kind="stable")
    x, y = centres.position_px[order].T
    first = np.searchsorted(x, middles - half_px, side="left")
    last = np.searchsorted(x, middles + half_px, side="right")
    weight = np.sqrt(centres.area_px[order])
    bottom = camera.height_px - 1.0
    across, along = x - camera.centre_x_px, y - camera.centre_y_px
    terms = np.stack([weight, weight * along, weight * across, weight * along**2, weight * along * across])
    sums = np.concatenate([np.zeros((len(terms), 1)), np.cumsum(terms, axis=1)], axis=1)
    total, s_y, s_x, s_yy, s_xy = sums[:, last] - sums[:, first]
    with np.errstate(divide="ignore", invalid="ignore"):
        spread = s_yy / total - (s_y / total) ** 2
        slope = (s_xy / total - s_x * s_y / total**2) / spread
        at_bottom = camera.centre_x_px + s_x / total + slope * (bottom - camera.centre_y_px - s_y / total)
        good = (last - first >= FEWEST_CENTRES) & (spread > (SMALLEST_SPREAD * camera.height_px) ** 2)
        good &= (np.abs(slope) < np.tan(FLATTEST_RAD)) & (at_bottom >= 0) & (at_bottom <= camera.width_px - 1)
    return WindowLines(
        np.where(good, at_bottom, np.nan), np.where(good, slope, np.nan), (last - first).astype(float)
    )


def _middles(finding: Finding, camera: Pinhole) -> Floats:
    """Where the window's middle stands at each position, such that the window lies within the image."""
    stride_px = finding.stride * camera.width_px
    to_edge_px = (1 - finding.window) * camera.width_px / 2
    steps = int(to_edge_px // stride_px)
    return np.asarray(camera.centre_x_px + stride_px * np.arange(-steps, steps + 1))
