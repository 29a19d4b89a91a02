"""`fieldnav log stats`: where a run's time and way went, and how narrowly its decisions fell."""

from collections.abc import Iterator

from rich.console import Console

from fieldnav.cli.console import out, print_json
from fieldnav.cli.log.near_misses import Missed, near_misses
from fieldnav.cli.log.options import RUNS, JsonOption, RunArgument, RunsOption
from fieldnav.cli.log.stats_json import as_json
from fieldnav.cli.log.stats_tables import (
    events_table,
    lanes_table,
    left_out,
    loop_line,
    missed_table,
    states_table,
    troubles_table,
)
from fieldnav.cli.log.tables import heading
from fieldnav.inquiry.lines import JournalLines
from fieldnav.inquiry.outcome import Overview, overview
from fieldnav.inquiry.spent import Account, account
from fieldnav.inquiry.tally import Tally
from fieldnav.journal.directory import find_run
from fieldnav.journal.entry import Line


def stats(run: RunArgument = "last", runs: RunsOption = RUNS, json: JsonOption = False) -> None:
    """Add a run up: time and way in each state, transitions, margins, near misses, faults, lateness."""
    directory = find_run(run, runs)
    made, ended = Tally(), overview(directory)
    with JournalLines(directory.journal) as journal:
        spent = account(_tallied(journal, made), ended.seconds)
    missed = near_misses(directory)
    if json:
        print_json(as_json(ended, spent, made, missed))
    else:
        _print(out(), ended, spent, made, missed)


def _tallied(journal: JournalLines, made: Tally) -> Iterator[Line]:
    """The lines one after the other, each taken in on the way: a journal may be larger than the memory."""
    for placed in journal.forwards():
        line = journal.parse(placed)
        made.add(line)
        yield line


def _print(console: Console, ended: Overview, spent: Account, made: Tally, missed: Missed) -> None:
    console.print(heading(ended))
    for table in (states_table(spent), lanes_table(made)):
        console.print(table)
        console.print()
    console.print(events_table(made))
    console.print(left_out(made), style="dim")
    console.print()
    if made.faults or made.holds:
        console.print(troubles_table(made))
        console.print()
    if missed.misses:
        console.print(missed_table(missed))
    console.print(
        missed.lacking or ("" if missed.misses else "no event nearly came about and did not"), style="dim"
    )
    console.print(loop_line(ended.summary))
