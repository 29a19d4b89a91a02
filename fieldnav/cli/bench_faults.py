"""`fieldnav bench faults`: what the robot does about everything that can break, in every state."""

import os
from functools import partial
from math import isfinite
from typing import TYPE_CHECKING, Annotated

import typer
from rich.text import Text

from fieldnav.cli.bench_report import as_markdown as in_markdown
from fieldnav.cli.bench_run import JsonOption, MarkdownOption, QuickOption, ready_opencv, report_on
from fieldnav.cli.checkout import commit, machine
from fieldnav.cli.console import out, table
from fieldnav.cli.part_progress import watched
from fieldnav.faults import FAULTS

if TYPE_CHECKING:
    from fieldnav.evaluation.faults import Played
    from fieldnav.evaluation.faults_figures import Coverage

MOST_JOBS = 256
COLUMNS = (
    "fault",
    "declared",
    "noticed by",
    "as declared",
    "notice, s",
    "zero command, s",
    "standstill, s",
    "the journal says, for example",
)
RULES = ("states", "declared", "so it must go")
FIGURES = ("as declared", "notice, s", "zero command, s", "standstill, s")


def faults(
    only: Annotated[
        str,
        typer.Option(
            metavar="PAIR", help="One pair alone, 'camera black@Forward.Exit'; or a fault, or @STATE."
        ),
    ] = "",
    jobs: Annotated[
        int | None,
        typer.Option(min=1, max=MOST_JOBS, help="Missions side by side; as many as processors if not given."),
    ] = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
) -> None:
    """Let every fault strike in every state of a mission, and see what comes of it.

    A mission drives a sketched field through all its states; in each of them copies of it go on with a fault
    each, until what the table of faults declares has happened. Times are the slowest over the states: from
    the fault to the journal's first word of it, from there to a zero command on the bus, and to standstill.
    A pair fails that ends otherwise, runs over crop, leaves its lane, or is driven on stale sight.
    """
    ready_opencv(1)
    from fieldnav.evaluation.faults import FaultsPlan, play_all  # noqa: PLC0415 - loads OpenCV
    from fieldnav.evaluation.faults_figures import measure  # noqa: PLC0415 - the same

    plan = FaultsPlan(jobs or os.cpu_count() or 1, quick, only)
    if as_json:
        report_on("faults", partial(measure, plan), as_json=True, as_markdown=False)
        return
    with watched() as tell:
        played = play_all(plan, tell)
    title = f"faults: fieldnav {commit()} on {machine()}"
    if as_markdown:
        rules = in_markdown("What counts as declared, by state:", RULES, _rules(), ())
        print(
            "\n".join([in_markdown(title, COLUMNS, _rows(played), FIGURES), "", *_notes(played), "", rules])
        )
        return
    out().print(table("What counts as declared, by state", RULES, _rules()))
    out().print(table(title, COLUMNS, _rows(played), FIGURES))
    for note in _notes(played):
        out().print(Text(note), soft_wrap=True)


def _rows(played: "Played") -> list[list[str]]:
    from fieldnav.evaluation.faults_figures import coverage  # noqa: PLC0415 - see faults

    return [_row(each) for each in coverage(played.results)]


def _row(each: "Coverage") -> list[str]:
    declared = FAULTS[each.fault]
    times = (each.noticed_s, each.zero_s, each.standing_s)
    return [
        each.fault.value,
        declared.reaction.value,
        declared.noticed,
        f"{each.as_declared} of {each.pairs}",
        *(f"{seconds:.2f}" if isfinite(seconds) else "" for seconds in times),
        each.example,
    ]


def _rules() -> list[tuple[str, str, str]]:
    """What is expected where; states of which the same is expected share a line."""
    from fieldnav.evaluation.faults_injections import injections  # noqa: PLC0415 - see faults
    from fieldnav.evaluation.faults_rules import rules  # noqa: PLC0415 - see faults

    return [(rule.states, rule.reaction.value, rule.expected) for rule in rules(injections())]


def _notes(played: "Played") -> list[str]:
    """What it comes to, and each pair that did not end as declared."""
    from fieldnav.evaluation.faults_figures import again  # noqa: PLC0415 - see faults

    total = len(played.results) + len(played.unplayed)
    declared = len(played.results) - len(played.failed)
    stale = sum(each.stale_commands for each in played.results)
    run_over = sum(each.run_over for each in played.results)
    return [
        f"{declared} of {total} pairs as declared; {stale} commands to move on stale sight; "
        f"{run_over} crop plants run over.",
        *(f"{each.name}: {each.problem}; again: {again(each.name)}" for each in played.failed),
        *(
            f"{each.wanted.injection}@{each.wanted.leaf}: not played: {each.reason}"
            for each in played.unplayed
        ),
    ]
