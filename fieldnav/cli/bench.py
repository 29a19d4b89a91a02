"""`fieldnav bench`: what fieldnav achieves, measured now, beside its goals and the best values known."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.bench_report import document, markdown, report_table
from fieldnav.cli.checkout import commit, machine
from fieldnav.cli.console import out, print_json
from fieldnav.cli.output_folder import make_writable
from fieldnav.cli.part_progress import watched
from fieldnav.cli.picture_limit import limit_pictures
from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Plan, Progress, Report

bench = typer.Typer(
    name="bench",
    no_args_is_help=True,
    help="Measure what fieldnav achieves, beside its goals and the best values known.",
)

MOST_THREADS = 256

DataOption = Annotated[
    Path | None,
    typer.Option(
        envvar="FIELDNAV_DATA",
        metavar="DIR",
        help="Folder with the photographs: near_nadir_jw/ and crbd/, either or both.",
    ),
]
QuickOption = Annotated[bool, typer.Option("--quick", help="A smaller sample, in under a minute.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object, for programs.")]
MarkdownOption = Annotated[bool, typer.Option("--markdown", help="Print the table for a document.")]
ThreadsOption = Annotated[
    int | None, typer.Option(min=1, max=MOST_THREADS, help="Threads that OpenCV may use.")
]


@bench.command()
def detection(
    data: DataOption = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
    threads: ThreadsOption = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder that reliability.png is drawn into.")
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
    _ready_opencv(threads)
    from fieldnav.evaluation.detection import detection as measure  # noqa: PLC0415 - loads OpenCV

    _report("detection", measure, plan, as_json, as_markdown)


@bench.command()
def speed(
    data: DataOption = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
    threads: ThreadsOption = 1,
) -> None:
    """Time what is done to every frame, against the bare primitives it is made of.

    Photographs that are absent are left out, and the table says so.
    """
    plan = Plan(_folder(data), quick)
    _ready_opencv(threads)
    _report("speed", _speed, plan, as_json, as_markdown)


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
            f"--data {data}: there is no such folder; allowed is one that holds near_nadir_jw or crbd "
            "(the option's default is the environment variable FIELDNAV_DATA)"
        )
    return data


def _ready_opencv(threads: int | None) -> None:
    limit_pictures()  # a photograph's head may claim any size, which is allocated at once
    import cv2  # noqa: PLC0415 - other commands need not wait for OpenCV

    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)  # an error is one line, and fieldnav's
    if threads is not None:
        cv2.setNumThreads(threads)


def _report(
    name: str, measure: Callable[[Plan, Progress], Report], plan: Plan, as_json: bool, as_markdown: bool
) -> None:
    """Measure and print; the figures are reported whatever they are."""
    report = _measured(measure, plan)
    if as_json:
        print_json(document(name, commit(), report))
        return
    title = f"{name}: fieldnav {commit()} on {machine()}"
    if as_markdown:
        print(markdown(title, report))
        return
    out().print(report_table(title, report))


def _measured(measure: Callable[[Plan, Progress], Report], plan: Plan) -> Report:
    """Measure with a progress bar on the terminal; quiet where there is none."""
    with watched() as tell:
        return measure(plan, tell)
