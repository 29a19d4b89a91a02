"""The settings of a run as lists of keys and values."""

from collections.abc import Iterator, Mapping
from typing import Any

from fieldnav.settings.shown_source import HIDDEN, is_secret, shown

GENERAL = "run"


def settings_groups(settings: Mapping[Any, Any]) -> list[tuple[str, list[tuple[str, str]]]]:
    """A group for each part of settings.yaml, keys joined by dots; plain values make a group of their own."""
    plain = [(str(key), _text(value)) for key, value in settings.items() if not isinstance(value, Mapping)]
    groups = [(GENERAL, plain)] if plain else []
    groups += [
        (str(key), list(_flat(value))) for key, value in settings.items() if isinstance(value, Mapping)
    ]
    return [group for group in groups if group[1]]


def _flat(part: Mapping[Any, Any], before: str = "") -> Iterator[tuple[str, str]]:
    for key, value in part.items():
        name = f"{before}{key}"
        if isinstance(value, Mapping) and value:
            yield from _flat(value, f"{name}.")
        else:
            yield name, HIDDEN if is_secret(name) else _text(value)


def _text(value: object) -> str:
    if isinstance(value, list):
        return ", ".join(map(_text, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if value is None else shown(str(value))
