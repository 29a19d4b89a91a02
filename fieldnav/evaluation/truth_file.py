"""Files of ground truth: JSON, checked against what it must hold, every error naming the file."""

from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from fieldnav.errors import SettingsError
from fieldnav.evaluation.photographs import read_words
from fieldnav.settings.json_text import parse_json
from fieldnav.settings.problems import describe

Truth = TypeVar("Truth", bound=BaseModel)


def read_json(path: Path) -> object:
    """What a JSON file holds. Raises SettingsError."""
    text = read_words(path)
    try:
        return parse_json(text.encode())
    except SettingsError as error:
        raise SettingsError(f"{path}: {error}") from error


def checked(entry: object, kind: type[Truth], label: str) -> Truth:
    """The entry as a value of its kind. Raises SettingsError, beginning with the label."""
    try:
        return kind.model_validate(entry)
    except ValidationError as error:
        said = describe(error, kind)[0].removeprefix(": ")  # the whole entry has no key
        raise SettingsError(f"{label}: {said}") from error
