"""Findings as they are shown: a line for a person, an object for a program."""

import sys
from typing import Any

from rich.text import Text

from fieldnav.cli.console import drop, out
from fieldnav.preflight.finding import Finding, Verdict
from fieldnav.settings.one_line import one_line

COLOURS = {Verdict.OK: "green", Verdict.WARNING: "yellow", Verdict.FAIL: "bold red"}
VERDICT_WIDTH, CHECK_WIDTH = 9, 24
"""Columns of the longest verdict and the longest check, and a space."""


def line(finding: Finding) -> Text:
    """One line: verdict, check, figure and advice."""
    advice = f"; {finding.advice}" if finding.advice else ""
    return Text.assemble(
        (f"{finding.verdict.value:{VERDICT_WIDTH}}", COLOURS[finding.verdict]),
        one_line(f"{finding.check:{CHECK_WIDTH}}{finding.figure}{advice}"),
    )


def document(finding: Finding) -> dict[str, Any]:
    """The same as a JSON object."""
    return {
        "check": finding.check,
        "result": finding.verdict.value,
        "figure": finding.figure,
        "advice": finding.advice,
    }


def print_finding(finding: Finding) -> None:
    """Print the line; the checks go on, and a robot drives, where nobody reads it any more."""
    try:
        out().print(line(finding), soft_wrap=True)
    except (OSError, SystemExit):  # the console makes an exit of a reader that has gone
        drop(sys.stdout)
