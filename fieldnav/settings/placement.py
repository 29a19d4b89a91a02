"""Whether the lanes, rows and stretches that a field file names are in the field."""

from fieldnav.errors import SettingsError
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import ALL_ROWS, FieldSettings


def check_places(field: FieldSettings, crop: CropProfile) -> None:
    """Raise SettingsError for gaps outside the field, and for lanes or rows unsown that it has not got."""
    for index, gap in enumerate(field.gaps.placed):
        key = f"gaps.placed.{index}"
        _check_lane(field, f"{key}.lane", gap.lane)
        if gap.row != ALL_ROWS:
            _check_row(field, crop, f"{key}.row", gap.row)
        if gap.start_m + gap.length_m > field.length_m:
            raise SettingsError(
                f"field {field.name}: {key}: start_m {gap.start_m:g} with length_m {gap.length_m:g} is not "
                f"allowed; allowed is a gap that ends within the field's length_m {field.length_m:g}"
            )
    for index, lane in enumerate(field.unsown.lanes):
        _check_lane(field, f"unsown.lanes.{index}", lane)
    for index, row in enumerate(field.unsown.rows):
        _check_lane(field, f"unsown.rows.{index}.lane", row.lane)
        _check_row(field, crop, f"unsown.rows.{index}.row", row.row)
    if 1 in field.unsown.lanes or len(unsown_rows(field, 1)) == crop.rows.per_lane:
        raise SettingsError(
            f"field {field.name}: unsown: lane 1 is not allowed; allowed are lanes from 2 on: the robot is "
            f"set down at the first"
        )


def unsown_rows(field: FieldSettings, lane: int) -> set[int]:
    """The rows of a lane that were left out one by one, both as numbered in the file."""
    return {row.row for row in field.unsown.rows if row.lane == lane}


def _check_lane(field: FieldSettings, key: str, lane: int) -> None:
    if lane > field.lanes:
        raise SettingsError(
            f"field {field.name}: {key}: {lane} is not allowed; allowed is a whole number from 1 to "
            f"{field.lanes}, the field's lanes"
        )


def _check_row(field: FieldSettings, crop: CropProfile, key: str, row: int) -> None:
    most = crop.rows.per_lane
    if row > most:
        raise SettingsError(
            f"field {field.name}: {key}: {row} is not allowed; allowed is a whole number from 1 to {most}, "
            f"the rows.per_lane of crop {crop.name}"
        )
