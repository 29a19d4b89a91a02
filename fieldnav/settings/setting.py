"""One value of a settings file, named by its path: row_end.longest_gap_m."""

from collections.abc import Iterable
from typing import Any, TypeVar

from fieldnav.errors import SettingsError
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.documents import parse
from fieldnav.settings.loading import checked
from fieldnav.settings.model import Settings
from fieldnav.settings.one_line import one_line
from fieldnav.settings.problems import shortened
from fieldnav.settings.robot import Robot
from fieldnav.settings.shown_source import shown
from fieldnav.settings.strict_loader import RefusedError

Model = TypeVar("Model", bound=Settings)


def all_changed(crop: CropProfile, robot: Robot, changes: Iterable[str]) -> tuple[CropProfile, Robot]:
    """Crop and robot with each KEY=VALUE changed; the robot's keys begin with robot. Raises SettingsError."""
    for change in changes:
        key, equals, value = change.partition("=")
        if not equals:
            said = f"--set {shortened(shown(one_line(change)))}: has no '='"
            raise SettingsError(f"{said}; allowed is KEY=VALUE, say speeds.follow_mps=0.4")
        if key.startswith("robot."):
            robot = changed(robot, key.removeprefix("robot."), value)
        else:
            crop = changed(crop, key.removeprefix("crop."), value)
    return crop, robot


def changed(settings: Model, key: str, text: str) -> Model:
    """The same settings with one value changed, checked like a file; `text` as YAML has it.

    Raises SettingsError for a key that there is not, and for a value that is not allowed.
    """
    document = settings.model_dump(mode="json")
    *path, last = key.split(".")
    place: Any = document
    for part in path:
        place = place.get(part) if isinstance(place, dict) else None
    if not isinstance(place, dict) or last not in place:
        known = ", ".join(place if isinstance(place, dict) else document)
        raise SettingsError(f"--set {shortened(one_line(key))}: is no key; allowed is one of {known}")
    try:
        place[last] = parse(text, "--set")
    except SettingsError as error:
        cause = error.__cause__
        why = f": {one_line(str(cause.problem))}" if isinstance(cause, RefusedError) else ""
        raise SettingsError(f"--set {key}: '{shortened(shown(one_line(text)))}' is no value{why}") from error
    return checked(type(settings), document, "--set")
