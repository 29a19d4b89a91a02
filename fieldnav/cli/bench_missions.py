"""`fieldnav bench navigation`, `switching`, `row-ends`, `picture-watch`: what drives in simulation come
to."""

import os
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.bench_run import (
    JsonOption,
    MarkdownOption,
    PlotOption,
    QuickOption,
    ready_opencv,
    report_on,
)
from fieldnav.cli.output_folder import make_writable

MOST_JOBS, MOST_SEEDS, MOST_SWITCHES, LARGEST_SEED = 256, 1000, 100_000, 2**31 - 1 - 100_000
SHORTEST_M, LONGEST_M = 4, 2000
MOST_KILOMETRES = 1000

JobsOption = Annotated[
    int | None,
    typer.Option(min=1, max=MOST_JOBS, help="Runs side by side; as many as processors if not given."),
]
SeedOption = Annotated[
    int, typer.Option(min=0, max=LARGEST_SEED, help="The first seed; the others follow it.")
]


def navigation(
    fields: Annotated[
        str, typer.Option(metavar="NAMES", help="Some of the fields, with commas between them.")
    ] = "",
    seeds: Annotated[
        int | None,
        typer.Option(min=1, max=MOST_SEEDS, help="Seeds a field; 3 if not given."),
    ] = None,
    seed: SeedOption = 1,
    length: Annotated[
        float | None,
        typer.Option(min=SHORTEST_M, max=LONGEST_M, help="Length of the lanes, m; the paper's if not given."),
    ] = None,
    default_alone: Annotated[
        bool, typer.Option("--default-alone", help="Leave out the paper's ways to drive.")
    ] = False,
    jobs: JobsOption = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
    plot: PlotOption = None,
) -> None:
    """Drive a lane of each of the paper's fields, and of two with rows missing, through the whole pipeline.

    Three ways: the default, the paper's row finder with the default control, and the paper's both.
    Errors are the size of the distance from the lane's centre line and of the angle to it, mean and standard
    deviation over the length driven of all seeds; goals hold for the default alone.
    Yaw jerk is the second derivative of the true yaw rate, smoothed over half a second.
    """
    _ready(plot)
    from fieldnav.evaluation.navigation import NavigationPlan, in_short  # noqa: PLC0415 - loads OpenCV
    from fieldnav.evaluation.navigation import navigation as measure  # noqa: PLC0415 - the same
    from fieldnav.evaluation.navigation_configurations import Configuration  # noqa: PLC0415 - the same

    names = tuple(name.strip() for name in fields.split(",") if name.strip())
    plan = NavigationPlan(names, seed, length_m=length, jobs=jobs or processors(), plots=plot)
    plan = in_short(plan) if quick else plan
    plan = replace(plan, seeds=seeds) if seeds is not None else plan
    plan = replace(plan, ways=(Configuration.DEFAULT,)) if default_alone else plan
    report_on("navigation", partial(measure, plan), as_json, as_markdown, wide=True)


def switching(
    switches: Annotated[
        int | None, typer.Option(min=1, max=MOST_SWITCHES, help="Lane switches at least; 200 if not given.")
    ] = None,
    seed: SeedOption = 1,
    jobs: JobsOption = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
    plot: PlotOption = None,
) -> None:
    """Switch lanes in every crop, to both sides, past even and ragged row ends and uneven row distances.

    A switch has succeeded when the robot truly stands over the next lane, within half a row's distance of its
    centre line, as following starts. Five switches make a run; its seed decides crop, side and rows.
    --plot also writes the field files of runs that failed, for `fieldnav simulate`.
    """
    _ready(plot)
    from fieldnav.evaluation.switching import SwitchingPlan, in_short  # noqa: PLC0415 - loads OpenCV
    from fieldnav.evaluation.switching import switching as measure  # noqa: PLC0415 - the same

    plan = SwitchingPlan(seed=seed, jobs=jobs or processors(), plots=plot)
    plan = in_short(plan) if quick else plan
    plan = replace(plan, switches=switches) if switches is not None else plan
    report_on("switching", partial(measure, plan), as_json, as_markdown)


def row_ends(
    kilometres: Annotated[
        float,
        typer.Option(min=1, max=MOST_KILOMETRES, help="Of gappy rows; each with 20 ragged ends."),
    ] = 10.0,
    seed: SeedOption = 1,
    jobs: JobsOption = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
) -> None:
    """Drive gappy rows to their ends, and past many ragged ends: is a gap told from an end, and where is it?

    The field is sketched and the bus left out; perception, states, gate and wheels' errors are those of a
    mission. An end is missed when the robot stops more than 0.3 m from where it should.
    """
    _ready(None)
    from fieldnav.evaluation.benchmark import Plan, Progress, Report  # noqa: PLC0415 - see navigation
    from fieldnav.evaluation.row_end import row_end_figures  # noqa: PLC0415 - loads OpenCV

    def measure(tell: Progress) -> Report:
        figures = row_end_figures(Plan(None, quick, seed), tell, jobs or processors(), kilometres)
        return Report(tuple(figures))

    report_on("row-ends", measure, as_json, as_markdown)


def picture_watch(
    kilometres: Annotated[
        float, typer.Option(min=0.1, max=MOST_KILOMETRES, help="Of sketched fields.")
    ] = 200.0,
    drawn_kilometres: Annotated[
        float, typer.Option(min=0.1, max=MOST_KILOMETRES, help="Of fields as they look.")
    ] = 5.0,
    seed: SeedOption = 1,
    jobs: JobsOption = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
) -> None:
    """Drive up and down every shipped field and crop by the truth: are good pictures taken for bad ones?

    What the motion monitor and the other watches over a camera say against good pictures is a false alarm.
    200 km take some twelve hours of one core, 5 km as they look two.
    """
    _ready(None)
    from fieldnav.evaluation.benchmark import Plan, Progress, Report  # noqa: PLC0415 - see navigation
    from fieldnav.evaluation.picture_watching import picture_watch_figures  # noqa: PLC0415 - loads OpenCV

    def measure(tell: Progress) -> Report:
        plan, processes = Plan(None, quick, seed), jobs or processors()
        return Report(tuple(picture_watch_figures(plan, tell, processes, kilometres, drawn_kilometres)))

    report_on("picture-watch", measure, as_json, as_markdown)


def processors() -> int:
    """Processors of this machine."""
    return os.cpu_count() or 1


def _ready(plot: Path | None) -> None:
    if plot is not None:
        make_writable(plot, f"--plot {plot}:")
    ready_opencv(1)
