"""What every benchmark of the command line does: options that several take, measuring, printing."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.bench_report import document, markdown, report_table
from fieldnav.cli.bench_wide import wide_markdown, wide_table
from fieldnav.cli.checkout import commit, machine
from fieldnav.cli.console import out, print_json
from fieldnav.cli.output_folder import output_path
from fieldnav.cli.part_progress import watched
from fieldnav.cli.picture_limit import limit_pictures
from fieldnav.evaluation.benchmark import Progress, Report

QuickOption = Annotated[bool, typer.Option("--quick", help="A smaller sample, in under a minute.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object, for programs.")]
MarkdownOption = Annotated[bool, typer.Option("--markdown", help="Print the table for a document.")]
PlotOption = Annotated[
    Path | None,
    typer.Option(parser=output_path, metavar="DIR", help="Folder that pictures are drawn into."),
]


def ready_opencv(threads: int | None) -> None:
    """Let OpenCV use so many threads, its own number for None, and print nothing."""
    limit_pictures()  # a photograph's head may claim any size, which is allocated at once
    import cv2  # noqa: PLC0415 - other commands need not wait for OpenCV

    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)  # an error is one line, and fieldnav's
    if threads is not None:
        cv2.setNumThreads(threads)


def report_on(
    name: str, measure: Callable[[Progress], Report], as_json: bool, as_markdown: bool, wide: bool = False
) -> None:
    """Measure, with bars on a terminal, and print; the figures are reported whatever they are.

    A wide table has a line a case, for cases that have the same figures.
    """
    with watched() as tell:
        report = measure(tell)
    if as_json:
        print_json(document(name, commit(), report))
        return
    title = f"{name}: fieldnav {commit()} on {machine()}"
    if as_markdown:
        print(wide_markdown(title, report) if wide else markdown(title, report))
        return
    out().print(wide_table(title, report) if wide else report_table(title, report))
