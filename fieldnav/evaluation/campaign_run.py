"""One run of a campaign: driven in a folder that nothing is left in, judged by its true path."""

import shutil
from dataclasses import dataclass

from fieldnav.evaluation.path import PathObserver, paths_kept
from fieldnav.journal.journal import read
from fieldnav.journal.summary import Summary
from fieldnav.mission.simulated import Run, simulate


@dataclass(frozen=True, slots=True)
class Driven:
    """A run that has ended; `reason` says why when it did not finish."""

    observer: PathObserver
    summary: Summary
    reason: str


def drive(run: Run) -> Driven:
    """Drive a run and remove its directory. Raises FieldnavError as `simulate` does."""
    with paths_kept() as kept:
        directory, summary = simulate(run)
    lines = read(directory.journal)
    shutil.rmtree(directory.path)
    reason = "" if summary.completed or not lines else lines[-1].reason
    return Driven(kept[-1], summary, reason)
