"""`fieldnav bench kills`: missions whose process is killed at random moments, and resumed."""

import os
from dataclasses import replace
from functools import partial
from typing import Annotated

import typer

from fieldnav.cli.bench_run import JsonOption, MarkdownOption, QuickOption, ready_opencv, report_on

MOST_KILLS, MOST_JOBS, LARGEST_SEED = 1_000_000, 256, 2**31 - 1 - 1_000_000


def kills(
    at_least: Annotated[
        int | None,
        typer.Option("--kills", min=1, max=MOST_KILLS, help="Kills at least; 500 if not given."),
    ] = None,
    seed: Annotated[
        int, typer.Option(min=0, max=LARGEST_SEED, help="The first mission's seed; the others follow it.")
    ] = 1,
    jobs: Annotated[
        int | None,
        typer.Option(min=1, max=MOST_JOBS, help="Missions side by side; as many as processors if not given."),
    ] = None,
    quick: QuickOption = False,
    as_json: JsonOption = False,
    as_markdown: MarkdownOption = False,
) -> None:
    """Kill the process of a mission at random moments, resume it, and judge by the truth what was driven.

    The field, sketched, is a process of its own; the robot stands in it for some seconds after each kill.
    Missions of three short lanes are killed five to eight times each, often about a transition or while they
    resume. The seed decides when in the robot's time; where in its work a process is struck is up to chance.
    """
    ready_opencv(1)
    from fieldnav.evaluation.kills import KillsPlan, in_short, kill_soak  # noqa: PLC0415 - loads OpenCV

    plan = KillsPlan(seed=seed, jobs=jobs or os.cpu_count() or 1)
    plan = in_short(plan) if quick else plan
    plan = replace(plan, kills=at_least) if at_least is not None else plan
    report_on("kills", partial(kill_soak, plan), as_json, as_markdown)
