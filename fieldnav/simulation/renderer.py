"""What a camera sees of the simulated field: ground, then leaf over leaf, then colour."""

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats, Image
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.simulation.plan import FieldPlan
from fieldnav.simulation.rendering.cells import Block
from fieldnav.simulation.rendering.foliage import Foliage
from fieldnav.simulation.rendering.ground import GroundMap
from fieldnav.simulation.rendering.light import make_lighting
from fieldnav.simulation.rendering.models import grow_models
from fieldnav.simulation.rendering.painter import paint_leaves
from fieldnav.simulation.rendering.palette import colour_table, share_bands
from fieldnav.simulation.rendering.view import SKY_BGR, View
from fieldnav.simulation.rendering.wind import make_wind
from fieldnav.simulation.soil import make_soil
from fieldnav.simulation.texture import Texture

__all__ = ["FieldRenderer", "View"]

BLANK = 0  # the darkest soil, which no leaf has the colour of


class FieldRenderer:
    """Draws one field, from any view at any time; a picture depends on these and the field alone.

    A mirrored field is drawn as the plain field seen in a mirror, so that its pictures are the plain field's
    flipped, to the pixel.
    """

    def __init__(self, plan: FieldPlan, field: FieldSettings, crop: CropProfile) -> None:
        models = grow_models(plan.species, field.seed)
        bands = share_bands(len(plan.species))
        lighting = make_lighting(field.light)
        stand = plan.plants.mirrored(crop.rows.per_lane) if plan.mirrored else plan.plants
        azimuth_rad = float(np.deg2rad(field.light.sun_azimuth_deg))
        soil = make_soil(field.ground, azimuth_rad, field.light.sunshine, field.seed)
        self._mirrored = plan.mirrored
        self._foliage = Foliage(stand, models, bands, lighting)
        self._ground = GroundMap(soil, self._foliage, lighting, field.seed)
        self._colours = colour_table(field.ground.colour_bgr, models.palettes, bands)
        self._wind = make_wind(field.wind_mps, field.seed)

    def render(self, view: View, time_s: float) -> Image:
        """The picture, shape (height, width, 3), blue, green, red, that a faultless camera takes."""
        if self._mirrored:
            return np.asarray(cv2.flip(self._draw(view.mirrored(), time_s), 1), dtype=np.uint8)
        return self._draw(view, time_s)

    def _draw(self, view: View, time_s: float) -> Image:
        lower, upper = view.footprint(0.0)
        ground, mottle, to_map = self._ground.over(Block.around(lower, upper))
        canvas = _seen(ground, to_map, view)
        sky = _sky(view)
        if sky is not None:
            canvas[sky] = BLANK
        lower, upper = view.footprint(0.0, view.farthest_m)
        above_m = min(self._foliage.tallest_m, float(view.position_m[2]) / 2)
        above_lower, above_upper = view.footprint(above_m, view.farthest_m)
        beside = self._foliage.widest_m / 2
        rooted = Block.around(
            np.minimum(lower, above_lower) - beside, np.maximum(upper, above_upper) + beside
        )
        paint_leaves(canvas, view, self._foliage.within(rooted), self._wind, time_s)
        if sky is not None:
            sky &= canvas == BLANK
        cv2.add(canvas, _seen(mottle, to_map, view), dst=canvas)
        picture = np.asarray(cv2.applyColorMap(canvas, self._colours), dtype=np.uint8)
        if sky is not None:
            picture[sky] = SKY_BGR
        return picture


def _sky(view: View) -> NDArray[np.bool_] | None:
    """Where a view looks above the horizon, shape (height, width); None where it does not."""
    corners = view.sky_px
    if corners is None:
        return None
    sky = np.zeros((view.height_px, view.width_px), np.uint8)
    cv2.fillConvexPoly(sky, np.rint(corners).astype(np.int32), 1)
    return np.asarray(sky, bool)


def _seen(texture: Texture, to_texture: Floats, view: View) -> Texture:
    """A map of the ground as a view sees it, shape (height, width); it repeats where it ends."""
    size, flags = (view.width_px, view.height_px), cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP
    warped = cv2.warpPerspective(
        texture, to_texture @ view.ground, size, flags=flags, borderMode=cv2.BORDER_WRAP
    )
    return np.asarray(warped, dtype=np.uint8)
