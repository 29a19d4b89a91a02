"""One value of a settings file, named by its path: row_end.longest_gap_m."""

from typing import Any, TypeVar

import yaml

from fieldnav.errors import SettingsError
from fieldnav.settings.loading import checked
from fieldnav.settings.model import Settings
from fieldnav.settings.one_line import one_line
from fieldnav.settings.problems import shortened

Model = TypeVar("Model", bound=Settings)


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
        place[last] = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise SettingsError(f"--set {key}: '{shortened(one_line(text))}' is no value") from error
    return checked(type(settings), document, "--set")
