"""Many simulated runs side by side: each job in a process of its own kind, none able to end the others."""

import gc
import signal
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import active_children, get_context
from typing import Generic, TypeVar

from fieldnav.evaluation.benchmark import Progress

OF_A_TERMINAL = (signal.SIGINT, signal.SIGQUIT, signal.SIGHUP)
"""Signals that reach all of its processes at once."""

Job = TypeVar("Job")
Result = TypeVar("Result")


@dataclass(frozen=True, slots=True)
class Failed(Generic[Job]):
    """A job that gave no result, and why in one line; `died`: a process was lost, perhaps another job's."""

    job: Job
    reason: str
    died: bool = False


def run_campaign(
    part: str,
    work: Callable[[Job], Result],
    jobs: Sequence[Job],
    processes: int,
    progress: Progress,
) -> list[Result | Failed[Job]]:
    """What `work` makes of each job, in the jobs' order; `work` and all it takes and gives can be pickled.

    A process that dies, of memory say, takes its neighbours' jobs with it: those are tried again, each alone.
    Interrupted, every process is ended at once.
    """
    results: dict[int, Result | Failed[Job]] = {}

    def take(index: int, outcome: Result | Failed[Job]) -> None:
        results[index] = outcome
        progress(part, sum(not _lost(each) for each in results.values()), len(jobs))

    progress(part, 0, len(jobs))
    _run(work, dict(enumerate(jobs)), processes, take)
    for index in [index for index, outcome in results.items() if _lost(outcome)]:
        _run(work, {index: jobs[index]}, 1, take)
    progress(part, len(jobs), len(jobs))
    return [results[index] for index in range(len(jobs))]


def _lost(outcome: object) -> bool:
    return isinstance(outcome, Failed) and outcome.died


def _run(
    work: Callable[[Job], Result],
    jobs: Mapping[int, Job],
    processes: int,
    take: Callable[[int, Result | Failed[Job]], None],
) -> None:
    """Hand the outcome of each job over as soon as it is there."""
    if not jobs:
        return
    with _pool(min(processes, len(jobs))) as pool:
        with _interruptions_put_off():
            waiting = {pool.submit(_once, work, job): index for index, job in jobs.items()}
        for done in as_completed(waiting):
            error = done.exception()
            job = jobs[waiting[done]]
            take(waiting[done], done.result() if error is None else _failed(job, error))


def _once(work: Callable[[Job], Result], job: Job) -> Result:
    """One job in a process of the pool; a world and its cameras know each other, and hold much."""
    try:
        return work(job)
    finally:
        gc.collect()


def _failed(job: Job, error: BaseException) -> Failed[Job]:
    if isinstance(error, BrokenProcessPool):
        return Failed(job, "its process died", died=True)
    return Failed(job, " ".join(str(error).split()) or type(error).__name__)


@contextmanager
def _pool(processes: int) -> Iterator[ProcessPoolExecutor]:
    """Processes that are started anew, not forked, and do not outlive an interruption."""
    others = set(active_children())
    pool = ProcessPoolExecutor(processes, get_context("spawn"), _leave_interruptions_to_the_parent)
    try:
        yield pool
    except BaseException:
        for process in set(active_children()) - others:
            process.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def _interruptions_put_off() -> Iterator[None]:
    """The signals of a terminal come later, also to a process started here that does not ignore them yet.

    A block holds for this thread and for what it starts. A signal that another thread takes, one of numpy's
    say, would interrupt this one in the middle of a start all the same: it is noted, and raised afterwards.
    """
    noted: list[int] = []
    handlers = {number: signal.signal(number, lambda it, _: noted.append(it)) for number in OF_A_TERMINAL}
    before = signal.pthread_sigmask(signal.SIG_BLOCK, OF_A_TERMINAL)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for taken in noted:
            signal.raise_signal(taken)


def _leave_interruptions_to_the_parent() -> None:
    """Ctrl-C reaches every process of a terminal; the one that was started by it ends the rest."""
    for number in OF_A_TERMINAL:
        signal.signal(number, signal.SIG_IGN)
