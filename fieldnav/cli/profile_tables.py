"""The tables of `fieldnav profiles list`: a line a file, with what one chooses it by."""

from rich.table import Table

from fieldnav.cli.console import table
from fieldnav.settings.kinds import Kind, names_of
from fieldnav.settings.loading import load_crop, load_field, load_robot


def profile_table(kind: Kind) -> Table:
    """The shipped files of a kind."""
    match kind:
        case Kind.CROP:
            return _crops()
        case Kind.ROBOT:
            return _robots()
        case Kind.FIELD:
            return _fields()


def _crops() -> Table:
    columns = ("name", "rows", "plants every", "canopy, wide x high", "growth stage")
    rows = []
    for crop in map(load_crop, names_of(Kind.CROP)):
        plants = crop.plants
        rows.append(
            (
                crop.name,
                f"{crop.rows.per_lane} x {crop.rows.spacing_m:.2f} m",
                f"{plants.spacing_m:.2f} m",
                f"{plants.canopy_width_m:.2f} x {plants.canopy_height_m:.2f} m",
                crop.growth_stage,
            )
        )
    return table("crops", columns, rows)


def _robots() -> Table:
    columns = ("name", "track x wheelbase", "clearance", "top speed", "cameras", "CAN")
    rows = []
    for robot in map(load_robot, names_of(Kind.ROBOT)):
        shape, camera, can = robot.geometry, robot.cameras.front, robot.can
        rows.append(
            (
                robot.name,
                f"{shape.track_m:.2f} x {shape.wheelbase_m:.2f} m",
                f"{shape.clearance_m:.2f} m",
                f"{robot.limits.speed_mps:.2f} m/s",
                f"{camera.width_px}x{camera.height_px}, {camera.rate_hz:g}/s, {camera.tilt_deg:g} deg down",
                f"{can.interface} {can.channel}, {can.bitrate // 1000} kbit/s",
            )
        )
    return table("robots", columns, rows)


def _fields() -> Table:
    columns = ("name", "crop", "lanes", "length", "rows", "germination", "weeds/m2", "wind")
    rows = []
    for field in map(load_field, names_of(Kind.FIELD)):
        rows.append(
            (
                field.name,
                field.crop,
                str(field.lanes),
                f"{field.length_m:g} m",
                field.rows.shape.value,
                f"{field.gaps.germination * 100:.0f} %",
                f"{field.weeds.per_m2:g}",
                f"{field.wind_mps:g} m/s",
            )
        )
    return table(
        "fields (simulation)", columns, rows, right=("lanes", "length", "germination", "weeds/m2", "wind")
    )
