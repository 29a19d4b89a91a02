"""`python -m fieldnav.training.row_judge`: fit the judge of rows, write it as JSON.

It is fitted to the photographs whose folder is given, and to drawn pictures if any are asked for: with these
it reports fewer rows, also where there are some. `fieldnav bench detection` tells how it does on sets that it
was not fitted to.
"""

import argparse
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import TypeVar

from fieldnav.errors import FieldnavError, OutputError, SettingsError
from fieldnav.evaluation.benchmark import Plan
from fieldnav.evaluation.judge_fit import fit_judge
from fieldnav.evaluation.judged_candidates import JudgedPicture
from fieldnav.evaluation.judged_photographs import cases_of, judged_cases
from fieldnav.training.judged_rows import judged_pictures

FIRST_SEED = 1_000_000
"""Of pictures that no network was trained on."""
STEP = 25  # pictures handed to a process at a time
WRONG_INPUT = 2
Given = TypeVar("Given")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program; returns its exit status."""
    parser = argparse.ArgumentParser(prog="python -m fieldnav.training.row_judge", description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="the JSON file to write")
    parser.add_argument("--data", type=Path, help="folder of the photographs with known rows")
    parser.add_argument("--pictures", type=int, default=0, help="to draw besides")
    parser.add_argument("--processes", type=int, default=2)
    given = parser.parse_args(arguments)
    try:
        _check(given)
        cases = cases_of(Plan(given.data, quick=False))
    except FieldnavError as error:
        print(f"error: {error}", file=sys.stderr)
        return WRONG_INPUT
    photographs = [case for of_set in cases.values() for case in of_set]
    seeds = range(FIRST_SEED, FIRST_SEED + given.pictures)
    with ProcessPoolExecutor(given.processes, get_context("spawn")) as workers:
        judged = [
            *_each(workers, judged_cases, photographs, "photographs"),
            *_each(workers, judged_pictures, seeds, "drawn pictures"),
        ]
    text = json.dumps(fit_judge(judged).model_dump(), indent=1)
    given.out.write_text(text + "\n", encoding="utf-8")
    return 0


def _check(given: argparse.Namespace) -> None:
    if given.pictures < 0:
        raise SettingsError(f"--pictures {given.pictures}: must be 0 or more")
    if given.processes < 1:
        raise SettingsError(f"--processes {given.processes}: must be 1 or more")
    if given.data is not None and not given.data.is_dir():
        raise SettingsError(f"--data {given.data}: there is no such folder")
    if given.pictures == 0 and given.data is None:
        raise SettingsError("--pictures 0: without --data there is nothing to fit the judge to")
    if not given.out.parent.is_dir() or given.out.is_dir():
        raise OutputError(f"--out {given.out}: there is no folder for it, or a folder has its name")


def _each(
    workers: ProcessPoolExecutor,
    judge: Callable[[Sequence[Given]], list[JudgedPicture]],
    items: Sequence[Given],
    name: str,
) -> Iterator[JudgedPicture]:
    done = 0
    for part in workers.map(judge, [items[first : first + STEP] for first in range(0, len(items), STEP)]):
        done += len(part)
        print(f"{done} of {len(items)} {name}", file=sys.stderr, flush=True)
        yield from part


if __name__ == "__main__":
    sys.exit(main())
