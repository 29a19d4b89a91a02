"""What an unquoted value of a settings file stands for: null, true, false, a decimal number, or text.

Values that YAML readers disagree about (01024 is 1024 or 532, no is text or false) are refused with advice.
The same table serves writing: text that would be read as something else is written in quotes.
"""

import re
from collections.abc import Callable
from typing import Any

STRING = "tag:yaml.org,2002:str"
AMBIGUOUS = "!ambiguous"
"""The tag of a value that is refused."""

_CORE = {
    "null": r"~|null|Null|NULL|",
    "bool": r"true|True|TRUE|false|False|FALSE",
    "int": r"[-+]?(0|[1-9][0-9]*)",
    # An exponent without point and sign makes no number: 1234e5 is a serial number in hexadecimal digits.
    "float": r"[-+]?((0|[1-9][0-9]*)\.[0-9]*([eE][-+]?[0-9]+)?|\.[0-9]+([eE][-+]?[0-9]+)?"
    r"|(0|[1-9][0-9]*)[eE][-+][0-9]+)|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)",
}
_UNCLEAR = {
    "yes_or_no": r"y|Y|yes|Yes|YES|n|N|no|No|NO|on|On|ON|off|Off|OFF",
    "base_60": r"[-+]?[0-9][0-9_]*(:[0-5]?[0-9])+(\.[0-9_]*)?",
    "base_2_or_8": r"[-+]?0(b[01_]*[01]|o[0-7_]*[0-7])_*",
    "leading_zero": r"[-+]?0[0-9_]+(\.[0-9_]*)?",
    "underscore": r"[-+]?[0-9][0-9_]*_[0-9_]*(\.[0-9_]*)?|[-+]?[0-9]*\.[0-9]+_[0-9_]*",
}
_PATTERNS = {name: re.compile(rf"(?:{pattern})\Z") for name, pattern in (_CORE | _UNCLEAR).items()}
_HEXADECIMAL = re.compile(r"[-+]?0x[0-9a-fA-F]+\Z")
_EXPONENT = re.compile(r"[-+]?[0-9]+(\.[0-9]*)?([eE][-+]?[0-9]{1,2})?\Z")
_TRUE_WORDS = ("y", "yes", "on")

RESOLVERS: dict[Any, list[tuple[str, re.Pattern[str]]]] = {
    None: [
        (AMBIGUOUS if name in _UNCLEAR else f"tag:yaml.org,2002:{name}", pattern)
        for name, pattern in _PATTERNS.items()
    ]
}
"""For yaml's loaders: None stands for every first character."""
QUOTED = {None: [*RESOLVERS[None], (AMBIGUOUS, _HEXADECIMAL), (AMBIGUOUS, _EXPONENT)]}
"""For its dumpers: text that is none to other readers is put in quotes too."""


def advice(text: str) -> str:
    """Why a value that is refused is, and what to write instead."""
    kind = next(name for name in _UNCLEAR if _PATTERNS[name].match(text))
    reason, instead = _ADVICE[kind](text)
    return f"{text} is not allowed: {reason}; write {instead}, or write '{text}' in quotes for text"


def written_out(text: str) -> str:
    """The decimal digits of a text that people mean as a number, such as 0x10 or 1e3; empty for others."""
    if _HEXADECIMAL.match(text):
        return str(int(text, 16))
    return f"{float(text):.15g}" if _EXPONENT.match(text) else ""


def _yes_or_no(text: str) -> tuple[str, str]:
    meant = "true" if text.lower() in _TRUE_WORDS else "false"
    return "it is read as text by some and as true or false by others", meant


def _base_60(text: str) -> tuple[str, str]:
    return "it is read as a number in base 60 by some", "a decimal number"


def _base_2_or_8(text: str) -> tuple[str, str]:
    return "numbers are decimal", str(int(text.replace("_", ""), 0))


def _leading_zero(text: str) -> tuple[str, str]:
    sign, digits = ("-", text[1:]) if text[0] == "-" else ("", text.lstrip("+"))
    bare = digits.replace("_", "").lstrip("0")
    return "a number with leading zeros is octal to some", sign + (bare if bare[:1].isdigit() else f"0{bare}")


def _underscore(text: str) -> tuple[str, str]:
    return "numbers have no underscores", text.replace("_", "")


_ADVICE: dict[str, Callable[[str], tuple[str, str]]] = {
    "yes_or_no": _yes_or_no,
    "base_60": _base_60,
    "base_2_or_8": _base_2_or_8,
    "leading_zero": _leading_zero,
    "underscore": _underscore,
}
