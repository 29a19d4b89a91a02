"""A mission that is to be killed again and again, and what became of it."""

from collections import Counter
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

from drivers.simulated_module import WATCHDOG_S
from drivers.simulated_motion import DRIVE_RAMP_MPS2
from fieldnav.errors import FieldnavError
from fieldnav.evaluation.kills_mission import MissionSetup
from fieldnav.evaluation.kills_moment import MEAN_S
from fieldnav.journal.entry import Line
from fieldnav.journal.journal import read
from fieldnav.journal.ledger import last_booking
from fieldnav.journal.summary import Truth
from fieldnav.messages import Side
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot
from fieldnav.simulation.world import STEP_S
from states.names import text
from states.table import FINISHED


@dataclass(frozen=True, slots=True)
class SoakRun:
    """What is to be driven; the field's seed decides when the mission is killed, kills times at most.

    mean_s: of the robot's time between kills; folder: where the run's files are written, and left; None for a
    place that nothing is left in.
    """

    field: FieldSettings
    crop: CropProfile
    robot: Robot
    side: Side
    kills: int
    mean_s: float = MEAN_S
    folder: Path | None = None

    @property
    def title(self) -> str:
        return f"{self.field.name}, {self.crop.name}, {self.side.value}, seed {self.field.seed}"


@dataclass(slots=True)
class Soaked:
    """What became of a mission.

    kills: how many in each state; standstill_s, fastest_mps: how long after a kill a wheel turned, and how
    fast, at worst; over_s: how much longer than watchdog and ramp allow, at worst; unreadable: what was
    wrong with journal or ledger after a kill or at the end; reason: why it did not finish; unkilled: why
    it does not finish without a kill either, empty where it does; truth: what only the world knows.
    """

    run: SoakRun
    kills: Counter[str] = field(default_factory=Counter)
    standstill_s: float = 0.0
    fastest_mps: float = 0.0
    over_s: float = float("-inf")
    unreadable: list[str] = field(default_factory=list)
    reason: str = ""
    unkilled: str = ""
    truth: Truth | None = None

    @property
    def delay_s(self) -> float:
        """How late a last command may take effect: the bus's delay, and the world's step."""
        return self.run.field.wheel_errors.can_delay_s + STEP_S

    def stood(self, standstill_s: float, fastest_mps: float) -> None:
        """Take in how the wheels came to stand after a kill."""
        self.standstill_s = max(self.standstill_s, standstill_s)
        self.fastest_mps = max(self.fastest_mps, fastest_mps)
        allowed_s = WATCHDOG_S + fastest_mps / DRIVE_RAMP_MPS2 + self.delay_s
        self.over_s = max(self.over_s, standstill_s - allowed_s)

    @property
    def faults(self) -> list[str]:
        """All that went wrong, in one line each."""
        truth = self.truth
        said = [f"not resumed to the end: {self.reason}"] if self.reason else []
        said = [f"{each}; without a kill: {self.unkilled}" for each in said] if self.unkilled else said
        said += self.unreadable
        if truth is not None and not self.reason:
            said += [f"{truth.lanes_missed} lanes missed"] if truth.lanes_missed else []
        if truth is not None:
            said += [f"{truth.lanes_repeated} lanes driven twice"] if truth.lanes_repeated else []
            said += (
                [f"{truth.crop_plants_run_over} crop plants run over"] if truth.crop_plants_run_over else []
            )
        if self.over_s > 0:
            said.append(f"a wheel turned {self.over_s:.3f} s longer than watchdog and ramp allow")
        return said


def files_faults(setup: MissionSetup, finished: bool = False) -> list[str]:
    """What is wrong with a run's journal and ledger; a finished mission's say so, with each lane once."""
    try:
        lines = read(setup.journal) if setup.journal.exists() else []
        newest = last_booking(setup.ledger)
    except FieldnavError as error:
        return [str(error)]
    said = _out_of_order(setup, lines)
    if finished:
        every = tuple(range(1, setup.lanes + 1))
        if not lines or lines[-1].target != text(FINISHED):
            said.append(f"{setup.journal.name}: its last line is not that of the mission's end")
        if newest is None or not newest.finished or newest.done != every:
            said.append(f"{setup.ledger.name}: does not say that lanes {every} are done, each once")
    return said


def _out_of_order(setup: MissionSetup, lines: list[Line]) -> list[str]:
    name, said = setup.journal.name, []
    if [line.seq for line in lines] != list(range(len(lines))):
        said.append(f"{name}: its numbers have a gap")
    if any(later.stamp_s < line.stamp_s for line, later in pairwise(lines)):
        said.append(f"{name}: its times go back")
    return said
