"""Reading a YAML file strictly: plain data only, one mapping at the root, no key twice; and writing one."""

import re
from collections.abc import Hashable, Mapping
from typing import Any

import yaml

from fieldnav.errors import SettingsError
from fieldnav.settings.one_line import one_line
from fieldnav.settings.regular_file import read_regular
from fieldnav.settings.scalars import QUOTED, STRING
from fieldnav.settings.strict_loader import RefusedError, StrictLoader

LARGEST_FILE_BYTES = 100_000
"""Forty times the longest file that comes with fieldnav; what is larger is some other file."""


LINE_WIDTH = 110
"""Characters at which long text of a written file is folded."""
_OTHER_LINE_BREAKS = re.compile("[\x85\u2028\u2029]")
"""NEL, LS and PS: line breaks to some YAML readers and not to others, so they are written escaped."""


class _Dumper(yaml.SafeDumper):
    """Puts text in quotes that the strict loader would refuse or read as something else."""

    yaml_implicit_resolvers = QUOTED

    def represent_str(self, text: str) -> yaml.ScalarNode:
        """Text; in double quotes, the only ones with escapes, where a line break would not be read back."""
        return self.represent_scalar(STRING, text, style='"' if _OTHER_LINE_BREAKS.search(text) else None)


_Dumper.add_representer(str, _Dumper.represent_str)


def written(document: Mapping[str, object]) -> str:
    """A document of plain values as YAML that `parse` reads as the same."""
    return yaml.dump(dict(document), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=LINE_WIDTH)


def parse_mapping(text: str, label: str) -> dict[Hashable, Any]:
    """The mapping that a YAML text holds; `label` names the file. Raises SettingsError."""
    document = parse(text, label)
    if not isinstance(document, dict):
        found = "is empty" if document is None else f"holds a {_kind(document)}"
        raise SettingsError(f"{label}: {found}; allowed is a mapping of keys to values, 'key: value' a line")
    return document


def parse(text: str, label: str) -> Any:
    """What a YAML text holds; `label` says where it stands. Raises SettingsError."""
    try:
        return yaml.load(text, Loader=StrictLoader)
    except RefusedError as error:
        raise SettingsError(f"{label}: {_place(error)}{one_line(str(error.problem))}") from error
    except yaml.MarkedYAMLError as error:
        problem = one_line(error.problem or "unreadable")
        raise SettingsError(f"{label}: is not valid YAML: {_place(error)}{problem}") from error
    except yaml.YAMLError as error:
        raise SettingsError(f"{label}: is not valid YAML: {_in_one_line(error)}") from error
    except (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError) as error:
        # The library lets these through where a value looks like a number and is none.
        raise SettingsError(f"{label}: is not valid YAML: {_in_one_line(error)}") from error


def read_text(path: str) -> str:
    """The text of a settings file. Raises SettingsError."""
    try:
        return read_regular(path, LARGEST_FILE_BYTES).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SettingsError(f"{path}: is not a text file in UTF-8") from error


def _in_one_line(error: Exception) -> str:
    return one_line(" ".join(str(error).split()))


def _place(error: yaml.MarkedYAMLError) -> str:
    mark = error.problem_mark or error.context_mark
    return f"line {mark.line + 1}: " if mark else ""


def _kind(document: object) -> str:
    return "list" if isinstance(document, list) else "single value"
