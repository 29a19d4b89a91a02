"""`fieldnav log show`: the lines of a run's journal, all or some, as a table or a tree."""

from collections.abc import Sequence
from math import inf
from typing import Annotated

import typer
from rich.console import Console

from fieldnav.cli.console import out, print_json
from fieldnav.cli.log.options import RUNS, JsonOption, RunArgument, RunsOption
from fieldnav.cli.log.tables import heading, transitions_table
from fieldnav.cli.log.tree import lanes_tree
from fieldnav.errors import SettingsError
from fieldnav.inquiry.asked import ROUNDED_S
from fieldnav.inquiry.choice import Choice, Chosen, Only
from fieldnav.inquiry.lines import JournalLines
from fieldnav.inquiry.moment import seconds_of
from fieldnav.inquiry.outcome import overview
from fieldnav.journal.directory import find_run
from fieldnav.journal.entry import Line
from states.names import text
from states.table import LEAVES

MOST_SHOWN = 200
"""Lines that a person is shown without asking for all. Our choice."""


def show(
    run: RunArgument = "last",
    runs: RunsOption = RUNS,
    state: Annotated[str, typer.Option(help="Only into or out of this state, such as Tracking.")] = "",
    event: Annotated[str, typer.Option(help="Only on this event, or a part of its name.")] = "",
    lane: Annotated[int | None, typer.Option(help="Only in this lane.")] = None,
    from_: Annotated[str, typer.Option("--from", help="Only from this time on: 41.3 or 1:23.4.")] = "",
    to: Annotated[str, typer.Option("--to", help="Only until this time.")] = "",
    stops: Annotated[bool, typer.Option("--stops", help="Only stops and pauses.")] = False,
    last: Annotated[int | None, typer.Option("--last", min=1, help="Only the last so many.")] = None,
    all_: Annotated[bool, typer.Option("--all", help=f"All, not the newest {MOST_SHOWN} alone.")] = False,
    tree: Annotated[bool, typer.Option("--tree", help="Under lanes and phases instead of a table.")] = False,
    json: JsonOption = False,
) -> None:
    """Show a run's transitions: when, from where to where, on which event, and why."""
    choice = Choice(
        only=Only.STOPS if stops else Only.LINES,
        state=_known(state),
        event=event,
        lane=lane,
        from_s=seconds_of("--from", from_) - ROUNDED_S if from_ else -inf,
        to_s=seconds_of("--to", to) + ROUNDED_S if to else inf,
    )
    directory = find_run(run, runs)
    most = last or (None if all_ or json else MOST_SHOWN)
    with JournalLines(directory.journal) as journal:
        lines, more = Chosen(journal, choice).newest(most)
    if json:
        print_json([line.model_dump(mode="json") for line in lines])
        return
    console = out()
    console.print(heading(overview(directory)))
    _print(console, lines, more if last is None else 0, tree)


def _print(console: Console, lines: Sequence[Line], more: int, tree: bool) -> None:
    if not lines:
        console.print("no line of the journal is so")
        return
    if more:
        console.print(f"{more} older lines are not shown; --all shows them\n", style="dim")
    console.print(lanes_tree(lines) if tree else transitions_table(lines, console.width))


def _known(state: str) -> str:
    """The state as given. Raises SettingsError for one that is no part of a state's name."""
    names = {name for leaf in LEAVES for name in text(leaf).split(".")}
    wrong = [name for name in state.split(".") if name.lower() not in {known.lower() for known in names}]
    if state and wrong:
        raise SettingsError(
            f"--state: '{state}': '{wrong[0]}' is no state; allowed are {', '.join(sorted(names))}"
        )
    return state
