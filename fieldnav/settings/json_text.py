"""JSON that people and other programs can touch, read strictly: no key twice, numbers that are finite."""

import json
from typing import Any, NoReturn, TypeVar

from pydantic import BaseModel, ValidationError

from fieldnav.errors import SettingsError
from fieldnav.settings.one_line import one_line
from fieldnav.settings.problems import describe, shortened

Model = TypeVar("Model", bound=BaseModel)


def parse_json(text: bytes) -> Any:
    """What a JSON text holds. Raises SettingsError, also for what readers of JSON disagree about."""
    try:
        return json.loads(text.decode(), object_pairs_hook=_once, parse_constant=_refuse)
    except UnicodeDecodeError as error:
        raise SettingsError("is no text in UTF-8") from error
    except json.JSONDecodeError as error:
        raise SettingsError(f"is no JSON: line {error.lineno}, column {error.colno}: {error.msg}") from error
    except (ValueError, RecursionError) as error:  # a number of thousands of digits, endless nesting
        raise SettingsError("is no JSON: it has too many digits or levels") from error


def read_model(model: type[Model], text: bytes) -> Model:
    """What a JSON text holds. Raises SettingsError: the first wrong key, its value, what is allowed."""
    parse_json(text)
    try:
        return model.model_validate_json(text, strict=True)
    except ValidationError as error:
        raise SettingsError(describe(error, model)[0].removeprefix(": ")) from error


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    seen: set[str] = set()
    for key, _ in pairs:
        if key in seen:
            raise SettingsError(f"{shortened(one_line(key))}: is given twice; allowed is once")
        seen.add(key)
    return dict(pairs)


def _refuse(constant: str) -> NoReturn:
    raise SettingsError(f"{constant}: is not allowed; allowed are finite numbers")
