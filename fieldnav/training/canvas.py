"""The image while it is drawn: its size, shapes with smooth edges, blending and smooth noise.

x points right and y down, in pixels. A canvas is not clipped to 0..255 until the light is applied.
"""

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

Canvas = NDArray[np.float32]
"""Shape (HEIGHT_PX, WIDTH_PX, 3), channels blue, green, red, 255 standing for white."""
Coverage = NDArray[np.float32]
"""Shape (HEIGHT_PX, WIDTH_PX): how far each pixel is covered, 0 to 1."""
Colour = NDArray[np.float32]
"""Shape (3,): blue, green, red."""
Range = tuple[float, float]
"""The limits between which a value is drawn evenly."""

WIDTH_PX, HEIGHT_PX = (
    192,
    128,
)  # the network's input: rows an eleventh of the width apart are still told apart
X_PX, Y_PX = np.meshgrid(np.arange(WIDTH_PX, dtype=np.float32), np.arange(HEIGHT_PX, dtype=np.float32))
"""The column and the row of each pixel, shape (HEIGHT_PX, WIDTH_PX)."""
WHITE = 255

SUBPIXEL_BITS = 3  # shapes are placed to an eighth of a pixel; OpenCV takes such numbers as integers
SUBPIXELS = 1 << SUBPIXEL_BITS
MIN_RADIUS_SUBPIXELS = 4  # OpenCV draws nothing of a thinner ellipse

NOISE_DECAY = 0.75  # amplitude from one octave to the next finer: about that of natural surfaces
NOISE_ASPECT = 1.5  # cells across for each cell down, so that they are square on the canvas
SMALL = 1e-6  # keeps a division by a deviation of 0 finite


def chance(random: np.random.Generator, share: float) -> bool:
    """True in `share` of the calls."""
    return random.random() < share


def log_uniform(random: np.random.Generator, limits: Range) -> float:
    """A value between the limits whose logarithm is drawn evenly."""
    low, high = limits
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def shaded(colour: NDArray[np.floating], factor: float) -> Colour:
    """A colour made darker or lighter, clipped to 0..255."""
    return np.asarray(np.minimum(np.maximum(colour * factor, 0), WHITE), np.float32)


def fill_ellipse(
    canvas: Canvas,
    centre_px: tuple[float, float],
    radii_px: tuple[float, float],
    angle_deg: float,
    colour: Colour,
) -> None:
    """Fill an ellipse whose first radius lies `angle_deg` clockwise from the x axis."""
    axes = tuple(max(int(radius * SUBPIXELS), MIN_RADIUS_SUBPIXELS) for radius in radii_px)
    paint = colour.tolist()
    cv2.ellipse(canvas, _fixed(centre_px), axes, angle_deg, 0, 360, paint, -1, cv2.LINE_AA, SUBPIXEL_BITS)


def draw_line(
    canvas: Canvas,
    start_px: tuple[float, float],
    end_px: tuple[float, float],
    colour: Colour,
    thickness_px: float,
) -> None:
    """Draw a straight line, at least one pixel thick."""
    thickness = max(1, int(thickness_px))
    ends = _fixed(start_px), _fixed(end_px)
    cv2.line(canvas, *ends, colour.tolist(), thickness, cv2.LINE_AA, SUBPIXEL_BITS)


def fill_polygon(canvas: Canvas | Coverage, corners_px: NDArray[np.float64], colour: Sequence[float]) -> None:
    """Fill a polygon, corners of shape (n, 2)."""
    corners = (corners_px * SUBPIXELS).astype(np.int32)
    cv2.fillPoly(canvas, [corners], colour, cv2.LINE_AA, SUBPIXEL_BITS)


def blend(canvas: Canvas, layer: Canvas, coverage: Coverage) -> None:
    """Lay another canvas over this one where `coverage` says so; changes `canvas`."""
    share = coverage[..., None]
    canvas *= 1 - share
    canvas += layer * share


def soften(coverage: NDArray[np.generic], sigma_px: float) -> Coverage:
    """A mask or coverage with smooth edges."""
    return np.asarray(cv2.GaussianBlur(coverage.astype(np.float32), (0, 0), sigma_px), np.float32)


def smooth_noise(random: np.random.Generator, octaves: int) -> Coverage:
    """Noise of unit deviation over the canvas, from two cells across to 2 ** octaves."""
    total = np.zeros((HEIGHT_PX, WIDTH_PX), np.float32)
    for octave in range(octaves):
        cells = 2 ** (octave + 1)
        shape = min(HEIGHT_PX, cells + 1), min(WIDTH_PX, int(cells * NOISE_ASPECT) + 1)
        grid = random.standard_normal(shape).astype(np.float32)
        total += NOISE_DECAY**octave * cv2.resize(grid, (WIDTH_PX, HEIGHT_PX), interpolation=cv2.INTER_CUBIC)
    return np.asarray(total / (total.std() + SMALL), np.float32)


def _fixed(point_px: tuple[float, float]) -> tuple[int, int]:
    return int(point_px[0] * SUBPIXELS), int(point_px[1] * SUBPIXELS)
