"""`fieldnav log list`: the runs there are, and how each ended."""

from fieldnav.cli.console import out, print_json, print_line
from fieldnav.cli.log.options import RUNS, JsonOption, RunsOption
from fieldnav.cli.log.tables import runs_table
from fieldnav.inquiry.outcome import overview
from fieldnav.journal.directory import runs_in


def list_runs(runs: RunsOption = RUNS, json: JsonOption = False) -> None:
    """List the runs, newest first, with how each ended."""
    overviews = [overview(run) for run in runs_in(runs)]
    if json:
        print_json([each.model_dump(mode="json") for each in overviews])
    elif overviews:
        console = out()
        console.print(runs_table(str(runs), overviews, console.width))
    else:
        print_line(f"no runs in {runs}; make one with: fieldnav simulate demo")
