"""One mission driven to its end although its process is killed again and again."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random
from signal import SIGKILL
from tempfile import TemporaryDirectory

from fieldnav.evaluation.kills_line import Ended
from fieldnav.evaluation.kills_mission import MissionSetup, run_mission
from fieldnav.evaluation.kills_moment import Kill, Killer, kills
from fieldnav.evaluation.kills_soaked import Soaked, SoakRun, files_faults
from fieldnav.evaluation.kills_world import ServedWorld
from fieldnav.evaluation.truth import judge
from fieldnav.journal.journal import read
from states.names import Top, text
from states.table import FINISHED

ALONE_S = (2.0, 5.0)
"""Of the robot's time, from a kill to the start of the next process."""
LIMIT_S = 900.0
"""Of the robot's time: several times what a mission of this size takes with all its kills."""
HANGS_S, CLOSES_S = 60.0, 10.0
"""Of the machine's time: who asks nothing for so long hangs; who has ended needs so long to close files."""
PROCESSES = get_context("forkserver")
"""Processes are forked from one that has everything imported, so that a kill costs no second of imports."""
PROCESSES.set_forkserver_preload([run_mission.__module__])


def soak(run: SoakRun) -> Soaked:
    """Drive a mission to its end through all its kills; one that stops is driven again without any.

    Raises FieldnavError for what does not fit.
    """
    soaked = _driven(run)
    if soaked.reason and run.kills:
        soaked.unkilled = _driven(replace(run, kills=0, folder=None)).reason
    return soaked


def _driven(run: SoakRun) -> Soaked:
    with _directory(run.folder) as folder:
        driven = _Soak(run, folder)
        driven.drive()
        driven.world.close()
    return driven.soaked


class _Soak:
    def __init__(self, run: SoakRun, folder: Path) -> None:
        self.soaked = Soaked(run)
        self.world = ServedWorld(run.field, run.crop, run.robot, run.side)
        self._setup = MissionSetup(folder, run.robot, run.crop, run.side, run.field.lanes)
        self._random = Random(run.field.seed)

    def drive(self) -> None:
        """One process after the other, the last of them left to live."""
        soaked, run = self.soaked, self.soaked.run
        moments = kills(self._random, run.mean_s)
        ended: Ended | None = None
        while ended is None and not soaked.reason:
            ended = self._process(next(moments) if soaked.kills.total() < run.kills else None)
        if ended is not None and ended.state != FINISHED:
            last = read(self._setup.journal)[-1]
            soaked.reason = f"{last.source} to {last.target}: {last.reason}"
        soaked.unreadable += files_faults(self._setup, finished=not soaked.reason)
        soaked.truth = judge(self.world.world, self.world.path, run.field.lanes)

    def _process(self, kill: Kill | None) -> Ended | None:
        """Let a process drive the mission on; None when it was killed, or died of something else."""
        line, far = PROCESSES.Pipe()
        process = PROCESSES.Process(target=run_mission, args=(self._setup, far), daemon=True)
        process.start()
        far.close()
        killer = Killer(process, kill, self._setup.journal) if kill else None
        try:
            ended = self._serve(line, killer)
        finally:
            if killer is not None:
                killer.call_off()
            line.close()
            process.join(CLOSES_S)
            process.kill()
            process.join()
        return ended or self._gone(process.exitcode)

    def _serve(self, line: Connection, killer: Killer | None) -> Ended | None:
        """Until the mission says that it has ended, or nobody asks any more."""
        begun_s = self.world.now_s
        try:
            self.world.begin(line)
            while self.world.now_s < LIMIT_S and line.poll(HANGS_S):
                if (ended := self.world.answer(line)) is not None:
                    return ended
                if killer is not None:
                    killer.time_is(self.world.now_s - begun_s)
        except (EOFError, OSError):  # the process is gone, be it in the middle of a word
            return None
        late = self.world.now_s >= LIMIT_S
        self.soaked.reason = (
            f"not at its end after {LIMIT_S:.0f} s of the robot's time"
            if late
            else f"the process did nothing for {HANGS_S:.0f} s"
        )
        return None

    def _gone(self, exitcode: int | None) -> Ended | None:
        """Note where it was, whether its files can be read, and how the wheels come to stand."""
        soaked, world = self.soaked, self.world
        state = world.told.state
        if soaked.reason:
            return None
        if exitcode != -SIGKILL:
            soaked.reason = f"the process ended by itself in {text(state)}, exit status {exitcode}"
            return None
        soaked.kills[text(state)] += 1
        soaked.unreadable += files_faults(self._setup)
        soaked.stood(*world.leave_alone(self._random.uniform(*ALONE_S)))
        return Ended(state) if Top.FAULT in state else None  # what had stopped is not to be resumed unseen


@contextmanager
def _directory(folder: Path | None) -> Iterator[Path]:
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        yield folder
        return
    with TemporaryDirectory(prefix="fieldnav-") as name:
        yield Path(name)
