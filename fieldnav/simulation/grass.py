"""The meadow about a field: tufts of grass beyond the row ends and beside the outermost rows."""

import numpy as np

from fieldnav.messages import Floats
from fieldnav.settings.field import FieldSettings
from fieldnav.simulation.centreline import Centreline
from fieldnav.simulation.plants import WEED_SPECIES
from fieldnav.simulation.rowlines import RowLines
from fieldnav.simulation.sowing import CROP, VARIANTS
from fieldnav.simulation.stand import NO_ROW, Stand
from fieldnav.simulation.streams import Stream, random_stream

GRASS = CROP + 1 + WEED_SPECIES.index("meadow-grass")
WIDTH_M = (0.12, 0.26)
HEIGHT_OVER_WIDTH = (0.4, 0.8)


def grow_grass(field: FieldSettings, line: Centreline, rows: RowLines) -> Stand:
    """The tufts of the field's grass edge; none where it has none."""
    random = random_stream(field.seed, Stream.GRASS)
    xy = line.position(*_places(random, field, rows).T)
    count = len(xy)
    width = random.uniform(*WIDTH_M, count)
    turn, sway = random.uniform(-np.pi, np.pi, (2, count))
    return Stand(
        x_m=xy[:, 0],
        y_m=xy[:, 1],
        heading_rad=turn,
        diameter_m=width,
        height_m=width * random.uniform(*HEIGHT_OVER_WIDTH, count),
        species=np.full(count, GRASS, np.int32),
        variant=random.integers(0, VARIANTS, count).astype(np.int32),
        is_crop=np.zeros(count, bool),
        lane=np.full(count, NO_ROW, np.int32),
        row=np.full(count, NO_ROW, np.int32),
        sway_rad=sway,
    )


def _places(random: np.random.Generator, field: FieldSettings, rows: RowLines) -> Floats:
    """(s, n) of the tufts, shape (count, 2), evenly over a frame about the field."""
    edge = field.grass_edge
    if not edge.present:
        return np.zeros((0, 2))
    inner = np.array(
        [
            [-edge.beyond_ends_m, rows.row_n_m.min() - edge.beside_m],
            [field.length_m + edge.beyond_ends_m, rows.row_n_m.max() + edge.beside_m],
        ]
    )
    lower, upper = inner[0] - edge.depth_m, inner[1] + edge.depth_m
    count = random.poisson(edge.tufts_per_m2 * float(np.prod(upper - lower)))
    spots = random.uniform(lower, upper, (count, 2))
    return np.asarray(spots[((spots < inner[0]) | (spots > inner[1])).any(axis=1)])
