"""How much crop stands along a lane's rows (paper III-A.3: where the row ends are judged)."""

import numpy as np

from fieldnav.messages import Centres, Floats, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import comb_of, widest_m
from fieldnav.perception.ground_plants import on_ground
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile


def crop_along_rows(
    centres: Centres, rows: tuple[RowLine, ...], crop: CropProfile, camera: Pinhole
) -> tuple[Floats, Floats]:
    """Where plants stand along a lane and how much crop they are, distance ahead and weight, shape (m,) each.

    A plant in a row counts by its area against a whole plant of the crop. One that stands in the lane but in
    no row counts against it, by as much as would stand in the rows if all grew there by chance: weeds, grass.
    """
    comb = comb_of(rows, crop, canopy_plane(camera, crop))
    plants = on_ground(centres, crop, camera)
    off = np.abs(comb.residual_m(plants)).min(axis=0)
    reach = np.minimum(plants.half_width_m, widest_m(crop))
    in_lane = off <= crop.rows.spacing_m / 2
    by_chance = reach / (crop.rows.spacing_m / 2 - reach)
    weight = np.where(off <= reach, plants.weight, -by_chance * plants.weight)
    return plants.position_m[in_lane, 0], weight[in_lane]
