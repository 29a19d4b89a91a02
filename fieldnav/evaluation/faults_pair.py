"""One pair: a fault strikes a rig in a state, and the rig goes on until what was declared has happened."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import nan

from fieldnav.evaluation.faults_expected import TARGETS, Expected, expected, goes_on_by_hand
from fieldnav.evaluation.faults_injection import PASSES_S, Injection
from fieldnav.evaluation.faults_judge import problem
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.evaluation.faults_witness import Witness
from fieldnav.faults import FaultKind
from states.names import text
from states.table import FINISHED, IDLE

UNNOTICED_S, REACTING_S = 60.0, 15.0
"""So long a fault may go unnoticed while it does no harm; so long its reaction may take from then."""
AT_REST_S = 3.0
"""So long a standing state is watched."""
GOING_ON_S, HELD_S, SLOW_S, KILLED_S = 6.0, 8.0, 6.0, 1.5
AFTERWARDS_S = 0.5
"""What comes after the reaction is watched for so long."""


@dataclass(frozen=True, slots=True)
class PairResult:
    """How a pair ended. Times in s, NaN where something never came; said: the journal's words."""

    injection: str
    fault: FaultKind
    leaf: str
    expected: Expected
    problem: str
    ended: str
    noticed_s: float
    zero_s: float
    standing_s: float
    said: str
    stale_commands: int
    run_over: int
    offset_m: float

    @property
    def name(self) -> str:
        """As the option --only has it."""
        return f"{self.injection}@{self.leaf}"


class Pair:
    """Strikes and watches."""

    def __init__(self, rig: Rig, injection: Injection) -> None:
        self._rig, self._injection = rig, injection
        self._wanted = expected(rig.leaf, injection)
        self._begun_s = rig.now_s
        self.witness = Witness(rig, injection)

    def play(self) -> PairResult:
        """Let it happen, and judge it."""
        rig, injection, witness = self._rig, self._injection, self.witness
        from_hand = goes_on_by_hand(witness.leaf, injection)
        injection.strike(rig)
        if witness.leaf == IDLE:
            rig.guarded(lambda: rig.mission.start(rig.now_s))
        elif from_hand or self._wanted is Expected.STANDS:
            self._watch(AT_REST_S)
            self._begun_s = rig.now_s  # before, nothing could be seen of most faults
        if from_hand and rig.leaf == witness.leaf and not rig.broken_off:
            rig.guarded(lambda: rig.operating.resume(rig.now_s))
        if self._wanted is not Expected.STANDS:
            for _ in self._rounds():
                rig.round()
        return self._result()

    def _watch(self, seconds: float) -> None:
        until_s = self._rig.now_s + seconds
        while self._rig.now_s < until_s:
            self._rig.round()

    def _rounds(self) -> Iterator[None]:
        """One by one until it is clear how the pair ends."""
        rig, begun_s = self._rig, self._rig.now_s
        match self._wanted:
            case Expected.GOES_ON | Expected.UNTOUCHED:
                yield from self._until(begun_s + GOING_ON_S)
            case Expected.MODULES_STOP:
                yield from self._until(begun_s + KILLED_S)
            case Expected.HELD:
                yield from self._until(self.witness.struck_s + PASSES_S)
                assert self._injection.passes, "only what passes is held for"
                self._injection.passes(rig)
                yield from self._until_going(rig.now_s + HELD_S)
                yield from self._until(rig.now_s + AFTERWARDS_S)
            case Expected.SLOWER:
                yield from self._until_noticed()
                yield from self._until(rig.now_s + SLOW_S)
            case _:
                yield from self._until_noticed()
                yield from self._until_ended(rig.now_s + REACTING_S)
                over_s = self.witness.struck_s + self._injection.lasts_s
                yield from self._until(max(rig.now_s, over_s) + AFTERWARDS_S)

    def _until(self, until_s: float) -> Iterator[None]:
        while self._rig.now_s < until_s:
            yield

    def _until_going(self, until_s: float) -> Iterator[None]:
        """Until it goes on: moves, or has come to another state."""
        leaf = self._rig.leaf
        while self._rig.now_s < until_s and self._rig.leaf == leaf and self._rig.told_zero:
            yield

    def _until_noticed(self) -> Iterator[None]:
        """The file is read only when it has grown, which every line makes it do."""
        rig, kinds = self._rig, self._injection.rightly
        until_s, sequence = rig.now_s + UNNOTICED_S, -1
        while rig.now_s < until_s and rig.leaf != FINISHED and not self._ended():
            if rig.paper.sequence != sequence:
                sequence = rig.paper.sequence
                if self.witness.noticed(kinds) is not None:
                    return
            yield

    def _until_ended(self, until_s: float) -> Iterator[None]:
        while self._rig.now_s < until_s and not (self._ended() and self.witness.stands):
            yield

    def _ended(self) -> bool:
        """A mission that a person must go on with changes no more; one that is paused may yet fail."""
        rig = self._rig
        return bool(rig.broken_off) or (rig.leaf in TARGETS.values() and rig.leaf != self.witness.leaf)

    def _result(self) -> PairResult:
        witness, injection = self.witness, self._injection
        line = witness.noticed(injection.also | injection.rightly)
        since_s = line.stamp_s if line else witness.struck_s
        timed = line is not None or self._wanted is Expected.MODULES_STOP
        return PairResult(
            injection=injection.name,
            fault=injection.fault,
            leaf=text(witness.leaf),
            expected=self._wanted,
            problem=problem(self._rig, injection, self._wanted, witness),
            ended=text(self._rig.leaf),
            noticed_s=max(0.0, since_s - self._begun_s) if line else nan,
            zero_s=witness.zero_after_s(since_s) if timed else nan,
            standing_s=witness.standing_after_s(since_s) if timed else nan,
            said=line.reason.replace(f"{self._rig.paper.folder}/", "") if line else "",
            stale_commands=witness.stale_commands,
            run_over=witness.run_over,
            offset_m=witness.offset_m,
        )
