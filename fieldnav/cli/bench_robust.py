"""`fieldnav bench fuzz`: what bad frames and broken files do."""

import os
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.bench_run import JsonOption, MarkdownOption, QuickOption, ready_opencv, report_on
from fieldnav.cli.output_folder import make_writable, output_path

MOST_FRAMES, MOST_FILES, MOST_JOBS, LARGEST_SEED = 1_000_000_000, 10_000_000, 256, 2**31 - 1


def fuzz(
    frames: Annotated[
        int | None, typer.Option(min=1, max=MOST_FRAMES, help="CAN frames; a million if not given.")
    ] = None,
    files: Annotated[
        int | None, typer.Option(min=1, max=MOST_FILES, help="Files; ten thousand if not given.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, max=LARGEST_SEED, help="Decides every frame and file.")] = 1,
    again: Annotated[
        str, typer.Option(metavar="CASE", help="One case alone, as a failure names it: driver:17, files:42.")
    ] = "",
    keep: Annotated[
        Path | None,
        typer.Option(
            parser=output_path, metavar="DIR", help="Folder that files which go wrong are written into."
        ),
    ] = None,
    jobs: Annotated[
        int | None,
        typer.Option(
            min=1, max=MOST_JOBS, help="Processes side by side; as many as processors if not given."
        ),
    ] = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
) -> None:
    """Throw random and changed CAN frames and broken files at fieldnav: no crash, no motion, clear errors.

    Frames meet a driver and a mission that stand, simulated modules that nobody started, and a mission that
    follows a lane; telegrams that only a host sends are kept from the last, whose modules would obey them.
    A file that is refused must be refused within a second, in one line that names it.
    """
    if keep is not None:
        make_writable(keep, f"--keep {keep}:")
    ready_opencv(1)
    from fieldnav.evaluation.fuzz import FuzzPlan, in_short, once_more  # noqa: PLC0415 - loads OpenCV
    from fieldnav.evaluation.fuzz import fuzz as measure  # noqa: PLC0415 - the same

    plan = FuzzPlan(seed=seed, jobs=jobs or os.cpu_count() or 1, kept=keep)
    plan = in_short(plan) if quick else plan
    plan = replace(plan, frames=frames or plan.frames, files=files or plan.files)
    report_on(
        "fuzz", partial(once_more, again, plan) if again else partial(measure, plan), as_json, as_markdown
    )
