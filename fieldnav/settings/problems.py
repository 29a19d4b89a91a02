"""What pydantic found wrong, said in one line: the key, its value, what is allowed."""

import json
from collections.abc import Mapping, Sequence
from datetime import datetime
from difflib import get_close_matches
from types import NoneType
from typing import Literal, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from fieldnav.settings.found import UNIONS, Found, find, is_enum, is_model, known_part
from fieldnav.settings.one_line import one_line
from fieldnav.settings.scalars import written_out
from fieldnav.settings.shown_source import HIDDEN, is_secret, shown

LONGEST_VALUE = 40
"""Characters of a bad value that are quoted; the rest would bury the message."""

BOUND_DIGITS = 12

MAX_REPORTED = 3
"""Problems of one text that are reported at once; a line of more is not read."""

MOST_DESCRIBED = 50
"""Problems of one file that are looked at; finding what was meant takes time for each."""

_BOUNDS = {"ge": "at least", "gt": "more than", "le": "at most", "lt": "less than"}


def describe(
    error: ValidationError, model: type[BaseModel], called: Mapping[str, str] | None = None
) -> list[str]:
    """A line for each problem in `error`, misspelt keys first; no line is said twice.

    `called` has other names for some of the keys.
    """
    problems = error.errors()[:MOST_DESCRIBED]
    unknown = [problem for problem in problems if problem["type"] == "extra_forbidden"]
    meant = {(*problem["loc"][:-1], _meant(problem, model)) for problem in unknown}
    rest = [problem for problem in problems if problem not in unknown and problem["loc"] not in meant]
    lines = (one_line(_line(problem, model, called or {})) for problem in [*unknown, *rest])
    return list(dict.fromkeys(lines))


def _meant(problem: ErrorDetails, model: type[BaseModel]) -> str:
    """The key that a misspelt one stands for; that it is missing need not be said as well."""
    owner = find(model, problem["loc"][:-1]).kind
    close = get_close_matches(str(problem["loc"][-1]), list(owner.model_fields), n=1)
    return close[0] if close else ""


def _line(problem: ErrorDetails, model: type[BaseModel], called: Mapping[str, str]) -> str:
    location = known_part(model, [part for part in problem["loc"] if part != "[key]"])
    key = shortened(".".join(str(part) for part in location))
    key = called.get(key, key)
    found, owner = find(model, location), find(model, location[:-1])
    value = HIDDEN if is_secret(key) else _quoted(problem["input"])
    if "[key]" in problem["loc"]:
        return f"{key}: there is no such key; {nearest(str(location[-1]), _keys(owner))}"
    match problem["type"]:
        case "extra_forbidden":
            return f"{key}: {value}: there is no such key; {nearest(str(location[-1]), _keys(owner))}"
        case "missing":
            return f"{key}: is missing; allowed is {_allowed(found)}"
        case "value_error" | "assertion_error":
            reason = str(problem.get("ctx", {}).get("error", problem["msg"]))
            if is_model(found.kind):  # the reason names what in the group does not go together
                return f"{key}: {reason}" if key else reason
            return f"{key}: {value}: {reason}"
    return f"{key}: {value} is not allowed; allowed is {_allowed(found)}{_instead(found, problem['input'])}"


def _instead(found: Found, value: object) -> str:
    """Advice on text where a number belongs, if that text looks like one."""
    if found.kind not in (int, float) or not isinstance(value, str):
        return ""
    number = written_out(value)
    return f"; write {number}" if number else ""


def nearest(word: str, known: Sequence[str]) -> str:
    """Advice on a word that is none of the known ones."""
    close = get_close_matches(word.lower(), known, n=1)
    meant = f"did you mean '{close[0]}'? " if close else ""
    return f"{meant}known are {', '.join(known)}"


def _allowed(found: Found) -> str:
    described = f" ({found.description})" if found.description else ""
    return f"{_kind(found)}{described}"


def _keys(found: Found) -> list[str]:
    """The keys that a group may hold."""
    if is_model(found.kind):
        return list(found.kind.model_fields)
    if get_origin(found.kind) is dict and is_enum(named := get_args(found.kind)[0]):
        return [str(member.value) for member in named]
    return []


def _kind(found: Found) -> str:
    kind = found.kind
    if keys := _keys(found):
        return f"a group of the keys {', '.join(keys)}"
    if is_enum(kind):
        return " or ".join(str(member.value) for member in kind)
    if get_origin(kind) is Literal:
        return " or ".join(str(value) for value in get_args(kind))
    if get_origin(kind) in (dict, tuple, *UNIONS):
        return _made_of(found)
    names = {float: "a number", int: "a whole number", bool: "true or false", str: "text"}
    names |= {datetime: "a time with its zone"}
    return " ".join([names.get(kind, "another value"), *_limits(found)])


def _made_of(found: Found) -> str:
    """What holds others: a mapping, a list, a choice of kinds."""
    arguments = get_args(found.kind)
    if get_origin(found.kind) is dict:
        return f"a group of keys, each with {_kind(Found(arguments[1]))}"
    if get_origin(found.kind) in UNIONS:
        kinds = [_kind(Found(each, found.constraints)) for each in arguments if each is not NoneType]
        return " or ".join([*kinds, "null"] if NoneType in arguments else kinds)
    if arguments[-1] is Ellipsis:
        return f"a list, each of {_kind(Found(arguments[0]))}"
    return f"[{', '.join(_kind(Found(each)) for each in arguments)}]"


def _limits(found: Found) -> list[str]:
    values = {
        name: getattr(item, name) for item in found.constraints for name in _BOUNDS if hasattr(item, name)
    }
    if "ge" in values and "le" in values:
        return [f"from {_plain(values['ge'])} to {_plain(values['le'])}"]
    return (
        [" and ".join(f"{_BOUNDS[name]} {_plain(value)}" for name, value in values.items())] if values else []
    )


def _plain(bound: float) -> str:
    """A bound in full: an address space's end in powers of ten helps nobody."""
    return f"{bound:.{BOUND_DIGITS}g}"


def _quoted(value: object) -> str:
    text = f"'{value}'" if isinstance(value, str) else json.dumps(value, default=str)
    return shortened(shown(text))


def shortened(text: str) -> str:
    """So much of a text as a message may quote."""
    return text if len(text) <= LONGEST_VALUE else f"{text[:LONGEST_VALUE]}..."
