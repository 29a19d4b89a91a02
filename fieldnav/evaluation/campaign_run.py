"""One run of a campaign: driven in a folder that nothing is left in, judged by its true path."""

import shutil
from dataclasses import dataclass

from fieldnav.evaluation.path import PathObserver
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
    run_made = simulate(run)
    lines = read(run_made.directory.journal)
    shutil.rmtree(run_made.directory.path)
    reason = "" if run_made.summary.completed or not lines else lines[-1].reason
    return Driven(run_made.driven, run_made.summary, reason)
