"""Leaves of the field's plants as arrays in the world, put together cell by cell and kept while in use."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.simulation.rendering.cells import CELL_M, Block, Kept
from fieldnav.simulation.rendering.light import Lighting
from fieldnav.simulation.rendering.models import Models
from fieldnav.simulation.rendering.palette import Band
from fieldnav.simulation.stand import Stand

Reals = NDArray[np.float32]

CELLS_KEPT = 500
BLOCKS_KEPT = 4  # two cameras, each on the border of two blocks


@dataclass(frozen=True, slots=True)
class Leaves:
    """Leaves of neighbouring plants, plant by plant, each plant's in the order of painting.

    outline: shape (n, v, 3), metres from `origin`; centre: (n, 3), middle of the outline; reach: (n,), metres
    from there to the farthest vertex; colour: (n,), numbers of colours; plant: (n,), index into the next two;
    top: (plants, 3), the plants' tops; sway_rad: (plants,). origin: world x and y.
    """

    outline: Reals
    centre: Reals
    reach: Reals
    colour: NDArray[np.uint8]
    plant: NDArray[np.int32]
    top: Reals
    sway_rad: Reals
    origin: tuple[float, float]


class Foliage:
    """The leaves that grow in any block of cells."""

    def __init__(self, stand: Stand, models: Models, bands: list[Band], lighting: Lighting) -> None:
        self._stand = stand
        self._models = models
        self._bands = bands
        self._lighting = lighting
        self._feet = np.stack([stand.x_m, stand.y_m, np.zeros(len(stand))], axis=-1)
        self._sizes = np.stack([stand.diameter_m, stand.diameter_m, stand.height_m], axis=-1).astype(
            np.float32
        )
        cell = np.floor(np.stack([stand.x_m, stand.y_m], axis=-1) / CELL_M).astype(int)
        order = np.lexsort((np.arange(len(cell)), cell[:, 1], cell[:, 0]))
        places, starts = np.unique(cell[order], axis=0, return_index=True)
        parts = np.split(order, starts[1:])
        self._rooted = {(int(x), int(y)): part for (x, y), part in zip(places, parts, strict=True)}
        self._cells = Kept(self._grow_cell, CELLS_KEPT)
        self._blocks = Kept(self._join_block, BLOCKS_KEPT)
        self.tallest_m = float(stand.height_m.max(initial=0.0))
        self.widest_m = float(stand.diameter_m.max(initial=0.0))

    def within(self, block: Block) -> Leaves:
        """Leaves of all plants rooted in a block of cells."""
        return self._blocks[block]

    def gather(self, cells: list[tuple[int, int]], origin: tuple[float, float]) -> Leaves:
        """Leaves of all plants rooted in the given cells, in metres from `origin`."""
        parts = [self._cells[cell] for cell in cells if cell in self._rooted]
        shifts = [np.array([p.origin[0] - origin[0], p.origin[1] - origin[1], 0], np.float32) for p in parts]
        counts = np.cumsum([0] + [len(p.top) for p in parts])
        if not parts:
            return _no_leaves(self._models.outline.shape[1], origin)
        return Leaves(
            outline=np.concatenate([p.outline + shift for p, shift in zip(parts, shifts, strict=True)]),
            centre=np.concatenate([p.centre + shift for p, shift in zip(parts, shifts, strict=True)]),
            reach=np.concatenate([p.reach for p in parts]),
            colour=np.concatenate([p.colour for p in parts]),
            plant=np.concatenate([p.plant + n for p, n in zip(parts, counts[:-1], strict=True)]),
            top=np.concatenate([p.top + shift for p, shift in zip(parts, shifts, strict=True)]),
            sway_rad=np.concatenate([p.sway_rad for p in parts]),
            origin=origin,
        )

    def _join_block(self, block: Block) -> Leaves:
        return self.gather(block.cells(), (block.first_x * CELL_M, block.first_y * CELL_M))

    def _grow_cell(self, cell: tuple[int, int]) -> Leaves:
        """The leaves of one cell's plants, in metres from the cell's corner."""
        origin = (cell[0] * CELL_M, cell[1] * CELL_M)
        rooted, stand, models = self._rooted[cell], self._stand, self._models
        leaf, plant = models.leaves_of(stand.species[rooted], stand.variant[rooted])
        owner = rooted[plant]
        turn = _turns(stand.heading_rad[owner])
        size = self._sizes[owner]
        foot = (self._feet[rooted] - (*origin, 0.0)).astype(np.float32)
        normal = np.einsum("nij,nj->ni", turn, models.normal[leaf])
        top = foot.copy()
        top[:, 2] = stand.height_m[rooted]
        return Leaves(
            outline=(models.outline[leaf] @ turn.transpose(0, 2, 1)) * size[:, None] + foot[plant, None],
            centre=np.einsum("nij,nj->ni", turn, models.centre[leaf]) * size + foot[plant],
            reach=np.hypot(models.across[leaf] * size[:, 0], models.rise[leaf] * size[:, 2]),
            colour=self._colours(leaf, normal),
            plant=plant.astype(np.int32),
            top=top,
            sway_rad=stand.sway_rad[rooted].astype(np.float32),
            origin=origin,
        )

    def _colours(self, leaf: NDArray[np.intp], normal: Reals) -> NDArray[np.uint8]:
        """Numbers of colours of leaves that face along `normal`, shape (n, 3)."""
        models = self._models
        brightness = self._lighting.on_leaves(normal, models.centre[leaf, 2])
        colour = np.zeros(len(leaf), np.uint8)
        for species, band in enumerate(self._bands):
            own = models.species[leaf] == species
            colour[own] = band.pick(models.tone[leaf][own], brightness[own])
        return colour


def _turns(heading_rad: Floats) -> Reals:
    """Rotations about the vertical, shape (n, 3, 3)."""
    cosine, sine = np.cos(heading_rad), np.sin(heading_rad)
    none, one = np.zeros_like(cosine), np.ones_like(cosine)
    rows = [[cosine, -sine, none], [sine, cosine, none], [none, none, one]]
    return np.moveaxis(np.array(rows, np.float32), -1, 0)


def _no_leaves(vertices: int, origin: tuple[float, float]) -> Leaves:
    return Leaves(
        outline=np.zeros((0, vertices, 3), np.float32),
        centre=np.zeros((0, 3), np.float32),
        reach=np.zeros(0, np.float32),
        colour=np.zeros(0, np.uint8),
        plant=np.zeros(0, np.int32),
        top=np.zeros((0, 3), np.float32),
        sway_rad=np.zeros(0, np.float32),
        origin=origin,
    )
