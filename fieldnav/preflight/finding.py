"""What a check found."""

from dataclasses import dataclass
from enum import Enum


class Verdict(Enum):
    """How a check stands; after a failed one no mission begins."""

    OK = "ok"
    WARNING = "warning"
    FAIL = "fail"


@dataclass(frozen=True, slots=True)
class Finding:
    """One check: what was looked at, how it stands, the figure, and what to do where it is not well."""

    check: str
    verdict: Verdict
    figure: str
    advice: str = ""


@dataclass(frozen=True, slots=True)
class Concern:
    """One thing that is not well among several that a check looks at."""

    verdict: Verdict
    words: str
    advice: str


_GRAVITY = list(Verdict)


def finding_of(check: str, figure: str, concerns: list[Concern]) -> Finding:
    """The check with its gravest concern's verdict and advice, and all concerns' words; well without any."""
    if not concerns:
        return Finding(check, Verdict.OK, figure)
    gravest = max(concerns, key=lambda concern: _GRAVITY.index(concern.verdict))
    words = "; ".join(concern.words for concern in concerns)
    return Finding(check, gravest.verdict, words, gravest.advice)
