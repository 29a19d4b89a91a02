"""Whether a crop's rows fit a robot, under it and beside its wheels, and a field fits a computer."""

from math import ceil

from fieldnav.errors import SettingsError
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.placement import check_places
from fieldnav.settings.robot import Geometry, Robot

MOST_PLANTS = 400_000
"""Chosen: sown within seconds and held in less than 100 MB; the largest shipped field has a tenth of them."""
CENTIMETRES = 100


def outer_canopy_m(crop: CropProfile) -> float:
    """Distance from a lane's centre line to the outer edge of its outermost row's canopy."""
    return (crop.rows.per_lane - 1) * crop.rows.spacing_m / 2 + crop.plants.canopy_width_m / 2


def check_fit(crop: CropProfile, robot: Robot, lane_pitch_m: float | None = None) -> None:
    """Raise SettingsError when a wheel would run on the crop, in this lane or (given the pitch) the next."""
    canopy_m, geometry = outer_canopy_m(crop), robot.geometry
    unfit = f"crop {crop.name} does not fit robot {robot.name}"
    inner_m = (geometry.track_m - geometry.wheel_width_m) / 2
    if canopy_m > inner_m:
        raise SettingsError(
            f"{unfit}: the crop's {_pattern(crop)} reach {canopy_m:.3f} m from the lane's centre; allowed is "
            f"at most {inner_m:.3f} m, where the wheels of the robot's {_stance(geometry)} begin"
        )
    if crop.plants.canopy_height_m > geometry.clearance_m:
        raise SettingsError(
            f"{unfit}: the crop's plants.canopy_height_m {crop.plants.canopy_height_m:g}; allowed is at most "
            f"the robot's geometry.clearance_m {geometry.clearance_m:g}"
        )
    outer_m = (geometry.track_m + geometry.wheel_width_m) / 2
    if lane_pitch_m is not None and lane_pitch_m - canopy_m < outer_m:
        least_m = ceil((outer_m + canopy_m) * CENTIMETRES) / CENTIMETRES
        raise SettingsError(
            f"the field's lane_pitch_m {lane_pitch_m:g} is too small for crop {crop.name} with its "
            f"{_pattern(crop)} and robot {robot.name} with its {_stance(geometry)}: the wheels would run on "
            f"the next lane's rows; allowed is at least {least_m:g}"
        )


def check_size(field: FieldSettings, crop: CropProfile) -> None:
    """Raise SettingsError for a field of more plants than can be drawn in time, and for places it has not."""
    check_places(field, crop)
    rows = field.lanes * crop.rows.per_lane
    plants = rows * (field.length_m / crop.plants.spacing_m + 1)
    weeds = field.weeds.per_m2 * field.lanes * field.lane_pitch_m * field.length_m
    grass = _tufts(field)
    if plants + weeds + grass > MOST_PLANTS:
        meadow = f", and {grass:.0f} tufts at grass_edge.tufts_per_m2 {field.grass_edge.tufts_per_m2:g}" * (
            grass > 0
        )
        raise SettingsError(
            f"field {field.name}: lanes {field.lanes} of length_m {field.length_m:g} hold about "
            f"{plants + weeds + grass:.0f} plants, {plants:.0f} of crop {crop.name} every plants.spacing_m "
            f"{crop.plants.spacing_m:g} and {weeds:.0f} weeds at weeds.per_m2 "
            f"{field.weeds.per_m2:g}{meadow}; allowed is at most {MOST_PLANTS}"
        )


def _tufts(field: FieldSettings) -> float:
    """About how many tufts of grass stand about a field."""
    edge = field.grass_edge
    if not edge.present:
        return 0.0
    inner_m = (field.length_m + 2 * edge.beyond_ends_m, field.lanes * field.lane_pitch_m + 2 * edge.beside_m)
    outer_m = [side_m + 2 * edge.depth_m for side_m in inner_m]
    return edge.tufts_per_m2 * (outer_m[0] * outer_m[1] - inner_m[0] * inner_m[1])


def _pattern(crop: CropProfile) -> str:
    return (
        f"rows.per_lane {crop.rows.per_lane} at rows.spacing_m {crop.rows.spacing_m:g} and "
        f"plants.canopy_width_m {crop.plants.canopy_width_m:g}"
    )


def _stance(geometry: Geometry) -> str:
    return f"geometry.track_m {geometry.track_m:g} and geometry.wheel_width_m {geometry.wheel_width_m:g}"
