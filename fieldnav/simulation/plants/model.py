"""A finished plant, and the gathering of its organs into one.

Plants stand at the origin, z up. While a plant grows its lengths are in any unit it likes; then its width and
its height are each brought to 1.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats

CANOPY_RADIUS = 0.5
"""Half of the normalised canopy diameter."""
LONGEST_REACH = 0.55
"""No leaf goes farther from the stem than this."""
FLOOR = (-np.inf, -np.inf, 0.0)
"""No leaf hangs below the ground."""
SECTORS = 8
"""Directions about the stem over which the canopy's reach is averaged."""
FLATTEST_UP = 0.45
"""Least upward part of a normal before it is made unit: thin upright blades let light through from behind."""


@dataclass(frozen=True, slots=True)
class PlantModel:
    """One plant, scaled to canopy diameter 1 and height 1, its leaves in painting order, low ones first.

    leaves: float32 (n_leaves, n_vertices, 3), closed outlines of leaves, half leaves, stalks and ribs,
    z in 0..1, x and y within LONGEST_REACH of the stem; short outlines repeat their last vertex.
    normals: float32 (n_leaves, 3), unit, facing up, of the plant in its species' usual proportions.
    tone: float32 (n_leaves,), place in the palette, 0 its first anchor, 1 its last.
    palette: uint8 (k, 3), evenly spaced anchors, blue, green, red, as lit by sun and sky together.
    """

    leaves: NDArray[np.float32]
    normals: NDArray[np.float32]
    tone: NDArray[np.float32]
    palette: NDArray[np.uint8]

    def colours(self) -> NDArray[np.float32]:
        """The leaves' colours before shading: float32 (n_leaves, 3), blue, green, red in 0..255."""
        anchors = np.linspace(0, 1, len(self.palette))
        channels = [np.interp(self.tone, anchors, channel) for channel in self.palette.T]
        return np.stack(channels, axis=-1).astype(np.float32)


@dataclass(slots=True)
class Foliage:
    """The organs of a growing plant; an organ's polygons are painted together, in the order given."""

    organs: list[tuple[float, list[Floats], list[float]]] = field(default_factory=list)

    def add(self, outlines: Sequence[Floats], tones: Sequence[float], below: float = 0.0) -> None:
        """Add one organ: outlines of shape (n_vertices, 3) and as many tones.

        It is painted by the mean height of its first outline, as if it stood `below` lower.
        """
        depth = float(outlines[0][:, 2].mean()) - below
        self.organs.append((depth, list(outlines), list(tones)))

    def finish(self, palette: NDArray[np.uint8], height: float) -> PlantModel:
        """The plant: organs sorted by height, padded to one number of vertices, normalised.

        `height` is the species' usual one in canopy diameters; normals are taken at that.
        """
        ordered = sorted(self.organs, key=lambda organ: organ[0])
        outlines = [outline for _, group, _ in ordered for outline in group]
        tones = [tone for _, _, group in ordered for tone in group]
        n_vertices = max(len(outline) for outline in outlines)
        leaves = np.stack([_padded(outline, n_vertices) for outline in outlines])
        leaves = (leaves * _scale(leaves)).clip(min=FLOOR)
        return PlantModel(
            leaves=leaves.astype(np.float32),
            normals=_normals(leaves * (1.0, 1.0, height)).astype(np.float32),
            tone=np.clip(tones, 0, 1).astype(np.float32),
            palette=palette,
        )


def _padded(outline: Floats, n_vertices: int) -> Floats:
    """The outline with its last vertex repeated to n_vertices."""
    return np.pad(outline, ((0, n_vertices - len(outline)), (0, 0)), mode="edge")


def _normals(leaves: Floats) -> Floats:
    """Unit normals by Newell's sum over the edges, turned to face up; without area straight up."""
    following = np.roll(leaves, -1, axis=1)
    normals = np.cross(leaves, following).sum(axis=1)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(length > 0, normals / np.maximum(length, np.finfo(float).tiny), (0.0, 0.0, 1.0))
    normals = np.where(normals[:, 2:] < 0, -normals, normals)
    normals[:, 2] = np.maximum(normals[:, 2], FLATTEST_UP)
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))


def _scale(leaves: Floats) -> Floats:
    """Factors of x, y and z, shape (3,), that bring the canopy's reach to CANOPY_RADIUS and its top to 1.

    The reach is the mean over sectors about the stem of the outermost vertex in each, as one who measures a
    canopy takes it; one long leaf does not shrink the plant unless it would pass LONGEST_REACH.
    """
    distance = np.hypot(leaves[..., 0], leaves[..., 1])
    turn = np.arctan2(leaves[..., 1], leaves[..., 0]) / (2 * np.pi) % 1
    sector = np.minimum((turn * SECTORS).astype(int), SECTORS - 1)
    reach = np.mean([distance[sector == i].max(initial=0.0) for i in range(SECTORS)])
    across = min(CANOPY_RADIUS / reach, LONGEST_REACH / distance.max())
    return np.array([across, across, 1 / leaves[..., 2].max()])
