"""`fieldnav log tail`: a running mission's transitions as they happen."""

import sys
import time
from functools import partial
from typing import Annotated

import typer
from rich.console import Console
from rich.text import Text

from fieldnav.cli.console import json_of, out
from fieldnav.cli.log.options import RUNS, JsonOption, RunArgument, RunsOption
from fieldnav.cli.log.tables import heading
from fieldnav.inquiry.cause import reason_of
from fieldnav.inquiry.following import follow
from fieldnav.inquiry.line_words import states_of
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.outcome import overview
from fieldnav.inquiry.stops import is_stop
from fieldnav.journal.directory import find_run
from fieldnav.journal.entry import Line
from fieldnav.settings.one_line import one_line

LAST = 10
POLL_S = 0.25
"""Between looks: sooner than a person reads. Our choice."""


def tail(
    run: RunArgument = "last",
    runs: RunsOption = RUNS,
    last: Annotated[int, typer.Option("--last", min=0, help="So many of the lines before.")] = LAST,
    json: JsonOption = False,
) -> None:
    """Print the last lines of a run's journal, then each new one, until the run has ended or Ctrl-C."""
    directory = find_run(run, runs)
    console = out()
    try:
        for line in follow(directory, last, partial(time.sleep, POLL_S), _say_broken_off):
            _print(console, line, json)
    except KeyboardInterrupt:
        return
    if not json:
        console.print()
        console.print(heading(overview(directory)))


def _print(console: Console, line: Line, json: bool) -> None:
    if json:
        print(json_of(line.model_dump(mode="json")), flush=True)
        return
    lane = "" if line.lane is None else f"lane {line.lane}  "
    because = one_line(reason_of(line))
    style = "bold red" if is_stop(line) else "bold"
    event, states = one_line(line.event), one_line(states_of(line))
    text = Text.assemble(
        (f"{clock(line.stamp_s):>7}  ", "dim"),
        lane,
        (event, style),
        f"  {states}",
    )
    console.print(
        text + Text(f"  {because}" if because else "", style="" if is_stop(line) else "dim"), soft_wrap=True
    )
    sys.stdout.flush()


def _say_broken_off() -> None:
    print("the run broke off; waiting for it to be resumed, Ctrl-C ends this", file=sys.stderr)
