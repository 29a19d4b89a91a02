"""Whether a crop's rows fit a robot: under it, between its wheels, and beside its wheels in the next lane."""

from fieldnav.errors import SettingsError
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.robot import Robot


def outer_canopy_m(crop: CropProfile) -> float:
    """Distance from a lane's centre line to the outer edge of its outermost row's canopy."""
    return (crop.rows.per_lane - 1) * crop.rows.spacing_m / 2 + crop.plants.canopy_width_m / 2


def check_fit(crop: CropProfile, robot: Robot, lane_pitch_m: float | None = None) -> None:
    """Raise SettingsError when a wheel would run on the crop, in this lane or (given the pitch) the next."""
    canopy_m = outer_canopy_m(crop)
    inner_m = (robot.geometry.track_m - robot.geometry.wheel_width_m) / 2
    if canopy_m > inner_m:
        raise SettingsError(
            f"crop {crop.name} does not fit robot {robot.name}: rows.per_lane {crop.rows.per_lane} at "
            f"rows.spacing_m {crop.rows.spacing_m:g} reach {canopy_m:.3f} m from the lane's centre; "
            f"allowed is at most {inner_m:.3f} m, where the wheels begin"
        )
    if crop.plants.canopy_height_m > robot.geometry.clearance_m:
        raise SettingsError(
            f"crop {crop.name} does not fit robot {robot.name}: plants.canopy_height_m "
            f"{crop.plants.canopy_height_m:g}; allowed is at most the clearance, "
            f"{robot.geometry.clearance_m:g} m"
        )
    outer_m = (robot.geometry.track_m + robot.geometry.wheel_width_m) / 2
    if lane_pitch_m is not None and lane_pitch_m - canopy_m < outer_m:
        raise SettingsError(
            f"lane_pitch_m {lane_pitch_m:g} is too small for crop {crop.name} and robot {robot.name}: "
            f"the wheels would run on the next lane's rows; allowed is at least {outer_m + canopy_m:.2f}"
        )
