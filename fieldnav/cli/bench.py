"""`fieldnav bench`: what fieldnav achieves, measured now, beside its goals and the best values known."""

import typer

from fieldnav.cli.bench_faults import faults
from fieldnav.cli.bench_kills import kills
from fieldnav.cli.bench_missions import navigation, picture_watch, row_ends, switching
from fieldnav.cli.bench_robust import fuzz
from fieldnav.cli.bench_sight import detection, speed

bench = typer.Typer(
    name="bench",
    no_args_is_help=True,
    help="Measure what fieldnav achieves, beside its goals and the best values known.",
)
bench.command()(detection)
bench.command()(navigation)
bench.command()(switching)
bench.command("row-ends")(row_ends)
bench.command("picture-watch")(picture_watch)
bench.command()(speed)
bench.command()(fuzz)
bench.command()(kills)
bench.command()(faults)
