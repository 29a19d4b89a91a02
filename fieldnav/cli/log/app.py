"""`fieldnav log`: the runs there are, and what happened in one, with the reason for each transition."""

import typer

from fieldnav.cli.log.diff import diff
from fieldnav.cli.log.export import export
from fieldnav.cli.log.list import list_runs
from fieldnav.cli.log.plot import plot
from fieldnav.cli.log.report import report
from fieldnav.cli.log.show import show
from fieldnav.cli.log.stats import stats
from fieldnav.cli.log.tail import tail
from fieldnav.cli.log.why import why

log = typer.Typer(name="log", no_args_is_help=True, help="Read what past runs did, and why.")

log.command("list")(list_runs)
log.command()(show)
log.command()(why)
log.command()(stats)
log.command()(plot)
log.command()(report)
log.command()(diff)
log.command()(tail)
log.command()(export)
