"""A moment of a run as people write it: a line's number, seconds, or minutes and seconds."""

import re
from dataclasses import dataclass
from math import isfinite

from fieldnav.errors import SettingsError

SECONDS_A_MINUTE = 60
ALLOWED = "a line's number such as 17, or a time such as 41.3, 41s or 1:23.4"
NUMBER = re.compile(r"\d+")
SECONDS = re.compile(r"(\d+(?:\.\d*)?|\.\d+)s?")
MINUTES = re.compile(r"(\d+):([0-5]?\d(?:\.\d*)?)")


@dataclass(frozen=True, slots=True)
class Moment:
    """The number of a line, or a time of the run."""

    seq: int | None = None
    at_s: float | None = None


def parse_moment(text: str) -> Moment | None:
    """What the text stands for; None where it is no moment."""
    if NUMBER.fullmatch(text):
        return Moment(seq=int(text))
    seconds_s = parse_seconds(text)
    return None if seconds_s is None else Moment(at_s=seconds_s)


def parse_seconds(text: str) -> float | None:
    """A time in s as people write it; None where it is none."""
    if match := MINUTES.fullmatch(text):
        return SECONDS_A_MINUTE * int(match[1]) + float(match[2])
    match = SECONDS.fullmatch(text)
    return float(match[1]) if match else None


def seconds_of(option: str, text: str) -> float:
    """The time that an option gives. Raises SettingsError."""
    seconds_s = parse_seconds(text)
    if seconds_s is None:
        raise SettingsError(f"{option}: '{text}': allowed is a time of the run such as 41.3 or 1:23.4")
    return seconds_s


def clock(seconds: float) -> str:
    """A time of the run as it is shown: minutes and seconds."""
    if not isfinite(seconds):
        return "unknown"
    minutes, rest = divmod(round(seconds, 1), SECONDS_A_MINUTE)
    return f"{int(minutes)}:{rest:04.1f}"
