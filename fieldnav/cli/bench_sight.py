"""`fieldnav bench detection` and `speed`: what is made of pictures, and how long it takes."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.bench_run import JsonOption, MarkdownOption, QuickOption, ready_opencv, report_on
from fieldnav.cli.output_folder import make_writable, output_path
from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Plan, Progress, Report

MOST_THREADS = 256

DataOption = Annotated[
    Path | None,
    typer.Option(
        envvar="FIELDNAV_DATA",
        metavar="DIR",
        help="Folder with the photographs, in any of near_nadir_jw/, crbd/, crdld/, no_rows/, row_faults/.",
    ),
]
ThreadsOption = Annotated[
    int | None, typer.Option(min=1, max=MOST_THREADS, help="Threads that OpenCV may use.")
]


def detection(
    data: DataOption = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
    threads: ThreadsOption = None,
    plot: Annotated[
        Path | None,
        typer.Option(parser=output_path, metavar="DIR", help="Folder that reliability.png is drawn into."),
    ] = None,
) -> None:
    """Find crop rows in photographs and in rendered fields, and where there are none.

    A row of a photograph counts as found at a confidence of at least 0.5;
    the reliability of the confidence is judged over all rows.
    Photographs that are absent are left out, and the table says so.
    """
    plan = Plan(_folder(data), quick, plots=plot)
    if plot is not None:
        make_writable(plot, f"--plot {plot}:")
    ready_opencv(threads)
    from fieldnav.evaluation.detection import detection as measure  # noqa: PLC0415 - loads OpenCV

    report_on("detection", partial(measure, plan), as_json, as_markdown)


def speed(
    data: DataOption = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
    threads: ThreadsOption = 1,
    hour: Annotated[
        bool,
        typer.Option("--hour", help="Drive one simulated hour instead: whether memory or cost grows."),
    ] = False,
) -> None:
    """Time what is done to every frame, against the bare primitives it is made of.

    Photographs that are absent are left out, and the table says so.
    With --hour a mission is driven for an hour of its own time, which takes some ten minutes.
    """
    plan = Plan(_folder(data), quick)
    ready_opencv(threads)
    report_on("speed", partial(_hour if hour else _speed, plan), as_json, as_markdown)


def _hour(plan: Plan, progress: Progress) -> Report:
    from fieldnav.evaluation.speed import hour as measure  # noqa: PLC0415 - loads OpenCV

    return measure(plan, progress)


def _speed(plan: Plan, progress: Progress) -> Report:
    from fieldnav.evaluation.photographs import PhotographSet  # noqa: PLC0415 - loads OpenCV
    from fieldnav.evaluation.speed import speed as measure  # noqa: PLC0415 - the same

    timed = PhotographSet.NEAR_NADIR
    left_out = () if timed.folder(plan) else (timed.absence(plan),)
    return Report(tuple(measure(plan, progress)), left_out)


def _folder(data: Path | None) -> Path | None:
    """The folder of photographs, None where none is named. Raises SettingsError where it does not exist."""
    if data is not None and not data.is_dir():
        raise SettingsError(
            f"--data {data}: there is no such folder; allowed is one that holds any of near_nadir_jw, crbd, "
            "crdld, no_rows and row_faults (the option's default is the environment variable FIELDNAV_DATA)"
        )
    return data
