"""Reading a YAML file strictly: plain data only, one mapping at the root, no key twice."""

import re
from collections.abc import Hashable
from pathlib import Path
from typing import Any

import yaml

from fieldnav.errors import SettingsError


class _StrictLoader(yaml.SafeLoader):
    """The safe loader, except that a key given twice is an error rather than silently the last one."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        seen: set[Hashable] = set()
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            if isinstance(key, Hashable) and key in seen:
                raise yaml.constructor.ConstructorError(
                    problem=f"key '{key}' is given twice", problem_mark=key_node.start_mark
                )
            seen.add(key if isinstance(key, Hashable) else str(key))
        return super().construct_mapping(node, deep)


_StrictLoader.add_implicit_resolver(
    # YAML 1.1, which the library follows, takes 5e-4 for text; nobody who writes it means that.
    "tag:yaml.org,2002:float",
    re.compile(r"^[-+]?[0-9]+[eE][-+]?[0-9]+$"),
    list("-+0123456789"),
)


def parse_mapping(text: str, label: str) -> dict[Hashable, Any]:
    """The mapping that a YAML text holds; `label` names the file. Raises SettingsError."""
    try:
        document = yaml.load(text, Loader=_StrictLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f" line {mark.line + 1}:" if mark else ""
        raise SettingsError(f"{label}: is not valid YAML:{place} {error.problem or 'unreadable'}") from error
    except yaml.YAMLError as error:
        raise SettingsError(f"{label}: is not valid YAML: {' '.join(str(error).split())}") from error
    except (ValueError, RecursionError) as error:  # an impossible date, endless nesting
        raise SettingsError(f"{label}: is not valid YAML: {error}") from error
    if not isinstance(document, dict):
        found = "is empty" if document is None else f"holds a {_kind(document)}"
        raise SettingsError(f"{label}: {found}; allowed is a mapping of keys to values, 'key: value' a line")
    return document


def read_text(path: Path) -> str:
    """The text of a file. Raises SettingsError."""
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError as error:
        raise SettingsError(f"{path}: there is no such file") from error
    except UnicodeDecodeError as error:
        raise SettingsError(f"{path}: is not a text file in UTF-8") from error
    except OSError as error:
        raise SettingsError(f"{path}: cannot be read: {error.strerror}") from error


def _kind(document: object) -> str:
    return "list" if isinstance(document, list) else "single value"
