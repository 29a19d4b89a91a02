"""What a check found: a line for a person, an object for a program."""

from dataclasses import dataclass
from enum import Enum
from typing import Any

from rich.text import Text


class Verdict(Enum):
    OK = "ok"
    WARNING = "warning"
    FAIL = "fail"


COLOURS = {Verdict.OK: "green", Verdict.WARNING: "yellow", Verdict.FAIL: "bold red"}
VERDICT_WIDTH, CHECK_WIDTH = 9, 24
"""Columns of the longest verdict and the longest check, and a space."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One check: what was looked at, how it stands, the figure, and what to do where it is not well."""

    check: str
    verdict: Verdict
    figure: str
    advice: str = ""

    def line(self) -> Text:
        advice = f"; {self.advice}" if self.advice else ""
        return Text.assemble(
            (f"{self.verdict.value:{VERDICT_WIDTH}}", COLOURS[self.verdict]),
            f"{self.check:{CHECK_WIDTH}}{self.figure}{advice}",
        )

    def document(self) -> dict[str, Any]:
        return {
            "check": self.check,
            "result": self.verdict.value,
            "figure": self.figure,
            "advice": self.advice,
        }
