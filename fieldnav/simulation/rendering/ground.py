"""The ground seen straight from above: soil, moisture and the plants' shadows, prepared cell by cell."""

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.simulation.rendering.cells import CELL_M, CELL_PIXELS, Block, Kept
from fieldnav.simulation.rendering.foliage import Foliage, Leaves
from fieldnav.simulation.rendering.light import Lighting
from fieldnav.simulation.rendering.palette import MOTTLE
from fieldnav.simulation.soil import Soil
from fieldnav.simulation.streams import Stream, random_stream
from fieldnav.simulation.texture import BARE, PIXEL_M, Texture, repeating_noise

CELLS_KEPT = 260  # 27 MB
BLOCKS_KEPT = 4
SHADOW_PIXELS = 160  # a cell's shadows are painted at half resolution
SHADOW_MARGIN = 16  # of them, for the blur to be the same on both sides of a cell's border
PENUMBRA_PIXELS = 0.9
CONTACT_PIXELS = 5.0  # blur of the darkness under a canopy
CONTACT_DARKNESS = 0.45  # share of the sky that a closed canopy hides
SUBPIXEL = 3  # bits
FULL = 255
SMALLEST_M = 0.003  # leaves reaching less than this from their middle cast no shadow
MOTTLE_PIXELS = 1024  # period 1.28 m
MOTTLE_CELLS = (64, 256, 512)
MOTTLE_SPREAD = 0.42  # rms, in steps

MOISTURE_CELL_STEPS = 4  # moisture is drawn every 0.1 m
MOISTURE_STEPS = 164  # period 16.4 m
MOISTURE_CELLS = (41, 82)
MOISTURE_SPREAD = 0.09  # rms of the brightness


class GroundMap:
    """Brightness of the ground as numbers of soil colours. Columns run along -y, rows along -x."""

    def __init__(self, soil: Soil, foliage: Foliage, lighting: Lighting, seed: int) -> None:
        self._crumbs = np.pad(soil.crumbs, (0, CELL_PIXELS), mode="wrap")
        self._litter = np.pad(soil.litter, (0, CELL_PIXELS), mode="wrap")
        self._periods = (len(soil.crumbs), len(soil.litter))
        self._foliage = foliage
        self._lighting = lighting
        self._moisture = _draw_moisture(seed)
        self._mottle = np.pad(_draw_mottle(seed), (0, CELL_PIXELS), mode="wrap")
        self._cells = Kept(self._paint_cell, CELLS_KEPT)
        self._blocks = Kept(self._join_block, BLOCKS_KEPT)

    def over(self, block: Block) -> tuple[Texture, Texture, Floats]:
        """(map, mottle, matrix) of a block of cells.

        mottle: blotches of 0 to 2 MOTTLE steps of brightness, of the same shape as the map, to be added to
        what is painted; matrix: shape (3, 3), from world (x, y) to pixels of both.
        """
        to_map = np.array(
            [
                [0, -1 / PIXEL_M, block.past_y * CELL_M / PIXEL_M - 0.5],
                [-1 / PIXEL_M, 0, block.past_x * CELL_M / PIXEL_M - 0.5],
                [0, 0, 1],
            ]
        )
        ground, mottle = self._blocks[block]
        return ground, mottle, to_map

    def _join_block(self, block: Block) -> tuple[Texture, Texture]:
        rows = range(block.past_x - 1, block.first_x - 1, -1)
        columns = range(block.past_y - 1, block.first_y - 1, -1)
        ground = np.block([[self._cells[x, y] for y in columns] for x in rows])
        mottle = np.block([[_cut(self._mottle, (x, y), MOTTLE_PIXELS) for y in columns] for x in rows])
        return ground, mottle

    def _paint_cell(self, cell: tuple[int, int]) -> Texture:
        crumbs = _cut(self._crumbs, cell, self._periods[0])
        litter = _cut(self._litter, cell, self._periods[1])
        surface = np.where(litter == BARE, crumbs, litter)
        return cv2.multiply(surface, self._light(cell), scale=1 / FULL).astype(np.uint8)

    def _light(self, cell: tuple[int, int]) -> Texture:
        """How bright the ground of a cell is, 255 in the open, shape (CELL_PIXELS, CELL_PIXELS)."""
        leaves = self._shading(cell)
        share = self._lighting.sun_share
        sun = cv2.GaussianBlur(self._cover(leaves, self._lighting.shadow_per_metre), (0, 0), PENUMBRA_PIXELS)
        sky = cv2.GaussianBlur(self._cover(leaves, np.zeros(2, np.float32)), (0, 0), CONTACT_PIXELS)
        open_sun, open_sky = 1 - sun / FULL, 1 - sky * (CONTACT_DARKNESS / FULL)
        light = FULL * (share * open_sun + (1 - share) * open_sky)
        inner = light[SHADOW_MARGIN:-SHADOW_MARGIN, SHADOW_MARGIN:-SHADOW_MARGIN]
        large = cv2.resize(inner, (CELL_PIXELS, CELL_PIXELS), interpolation=cv2.INTER_LINEAR)
        return np.asarray(np.clip(large * self._dryness(cell), 0, FULL), dtype=np.uint8)

    def _shading(self, cell: tuple[int, int]) -> Leaves:
        """Leaves of all plants whose shadow may reach a cell."""
        corner = np.array(cell, float) * CELL_M
        beside = self._foliage.widest_m / 2 + SHADOW_MARGIN * CELL_M / SHADOW_PIXELS
        back = -self._lighting.shadow_per_metre.astype(float) * self._foliage.tallest_m
        lower, upper = corner + np.minimum(back, 0) - beside, corner + CELL_M + np.maximum(back, 0) + beside
        return self._foliage.gather(Block.around(lower, upper).cells(), (float(corner[0]), float(corner[1])))

    def _cover(self, leaves: Leaves, per_metre: NDArray[np.float32]) -> Texture:
        """Where leaves, moved sideways by `per_metre` of their height, cover the ground: 0 or 255."""
        size = SHADOW_PIXELS + 2 * SHADOW_MARGIN
        cover = np.zeros((size, size), np.uint8)
        scale = SHADOW_PIXELS / CELL_M
        margin_m = SHADOW_MARGIN / scale
        middle = leaves.centre[:, :2] + leaves.centre[:, 2:] * per_metre
        reach = leaves.reach * (1 + np.abs(per_metre).max()) + margin_m
        near = (np.abs(middle - CELL_M / 2) < CELL_M / 2 + reach[:, None]).all(axis=1)
        outline = leaves.outline[near & (leaves.reach > SMALLEST_M), ::2]
        ground = outline[..., :2] + outline[..., 2:] * per_metre
        # columns run along -y and rows along -x, both from the cell's far corner
        corners = (CELL_M - ground[..., ::-1]) * scale + (SHADOW_MARGIN - 0.5)
        fill, outlines = cv2.fillConvexPoly, np.rint(corners * (1 << SUBPIXEL)).astype(np.int32)
        for polygon in outlines:
            fill(cover, polygon, FULL, cv2.LINE_8, SUBPIXEL)
        return cover

    def _dryness(self, cell: tuple[int, int]) -> NDArray[np.float32]:
        """Brightness by moisture, continuous over the cells' borders, shape (CELL_PIXELS, CELL_PIXELS)."""
        first_row, first_column = (-(index + 1) * MOISTURE_CELL_STEPS for index in cell)
        steps = np.arange(-1, MOISTURE_CELL_STEPS + 1)
        part = self._moisture.take(first_row + steps, 0, mode="wrap").take(
            first_column + steps, 1, mode="wrap"
        )
        scale = CELL_PIXELS // MOISTURE_CELL_STEPS
        large = cv2.resize(part, None, fx=scale, fy=scale, interpolation=cv2.INTER_LINEAR)
        return np.asarray(large[scale:-scale, scale:-scale])


def _draw_mottle(seed: int) -> Texture:
    """Blotches a few millimetres wide, shape (MOTTLE_PIXELS, MOTTLE_PIXELS)."""
    random = random_stream(seed, Stream.MOTTLE)
    noise = sum(repeating_noise(random, MOTTLE_PIXELS, cells) for cells in MOTTLE_CELLS)
    return np.asarray(np.clip(np.rint(MOTTLE + MOTTLE_SPREAD * noise), 0, 2 * MOTTLE), dtype=np.uint8)


def _draw_moisture(seed: int) -> NDArray[np.float32]:
    random = random_stream(seed, Stream.MOISTURE)
    noise = sum(repeating_noise(random, MOISTURE_STEPS, cells) for cells in MOISTURE_CELLS)
    return np.asarray(1 + MOISTURE_SPREAD * np.clip(noise, -2, 2), dtype=np.float32)


def _cut(texture: Texture, cell: tuple[int, int], period: int) -> Texture:
    """A cell's part of a repeating texture that is padded by one cell."""
    row, column = (-(index + 1) * CELL_PIXELS % period for index in cell)
    return texture[row : row + CELL_PIXELS, column : column + CELL_PIXELS]
