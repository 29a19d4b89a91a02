"""The figures of the faults: pairs as declared; the slowest notice, zero command and standstill of each."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite, nan

from drivers.simulated_module import WATCHDOG_S
from drivers.simulated_motion import DRIVE_RAMP_MPS2
from fieldnav.evaluation.benchmark import Better, Failure, Figure, LeftOut, Progress, Report
from fieldnav.evaluation.faults import AT, FaultsPlan, Played, play_all
from fieldnav.evaluation.faults_expected import Expected
from fieldnav.evaluation.faults_pair import PairResult
from fieldnav.faults import FAULTS, FaultKind, Reaction

ALL = "all pairs"
PERCENT = 100
STOPPED_WITHIN_S = 0.3
"""From a fault's notice until the wheels stand."""
FOLLOWED_MPS = 0.5
"""The working speed, from which the modules' ramp takes a third of a second."""
STOPPING = frozenset(
    {Expected.HELD, Expected.PAUSES, Expected.STOPS, Expected.LATCHES, Expected.MODULES_STOP}
)


@dataclass(frozen=True, slots=True)
class Coverage:
    """One fault over all states; times: the slowest, NaN where there is none; example: of the journal."""

    fault: FaultKind
    pairs: int
    as_declared: int
    noticed_s: float
    zero_s: float
    standing_s: float
    example: str


def measure(plan: FaultsPlan, progress: Progress) -> Report:
    """Play the pairs of a plan and report on them. Raises SettingsError."""
    played = play_all(plan, progress)
    left_out = tuple(
        LeftOut(f"{each.wanted.injection}{AT}{each.wanted.leaf}", each.reason) for each in played.unplayed
    )
    failures = tuple(Failure(each.name, each.problem, again(each.name)) for each in played.failed)
    return Report(tuple(_figures(played)), left_out, failures)


def again(name: str) -> str:
    """The command that plays a pair once more."""
    return f'fieldnav bench faults --only "{name}"'


def coverage(results: Sequence[PairResult]) -> list[Coverage]:
    """A line for each fault that was played, in the order of the table of faults."""
    made = []
    for fault in FAULTS:
        of = [result for result in results if result.fault is fault]
        if of:
            made.append(_covered(fault, of))
    return made


def _covered(fault: FaultKind, results: Sequence[PairResult]) -> Coverage:
    stopped = [each for each in results if each.expected in STOPPING]
    said = [each.said for each in stopped or results if each.said]
    return Coverage(
        fault=fault,
        pairs=len(results),
        as_declared=sum(not each.problem for each in results),
        noticed_s=_worst(each.noticed_s for each in results),
        zero_s=nan if fault is FaultKind.PROCESS_KILLED else _worst(each.zero_s for each in stopped),
        standing_s=_worst(each.standing_s for each in stopped),
        example=max(said, key=said.count) if said else "",
    )


def _worst(times: Iterator[float]) -> float:
    return max((each for each in times if isfinite(each)), default=nan)


def _figures(played: Played) -> Iterator[Figure]:
    results, total = played.results, len(played.results) + len(played.unplayed)
    declared = PERCENT * sum(not each.problem for each in results) / total if total else nan
    yield Figure(ALL, "in the declared reaction, %", declared, goal=PERCENT)
    stale, run_over = (sum(each.stale_commands for each in results), sum(each.run_over for each in results))
    yield Figure(ALL, "commands to move on stale sight", stale, goal=0, better=Better.LOWER)
    yield Figure(ALL, "crop plants run over", run_over, goal=0, better=Better.LOWER)
    for each in coverage(results):
        case = each.fault.value
        yield Figure(
            case, "in the declared reaction, %", PERCENT * each.as_declared / each.pairs, goal=PERCENT
        )
        for metric, seconds, goal in (
            ("slowest notice, s", each.noticed_s, None),
            ("slowest zero command, s", each.zero_s, STOPPED_WITHIN_S),
            ("slowest standstill, s", each.standing_s, standstill_goal_s(each.fault)),
        ):
            if isfinite(seconds):
                yield Figure(case, metric, seconds, goal=goal, better=Better.LOWER)


def standstill_goal_s(fault: FaultKind) -> float:
    """From notice on; without a host from the fault on: the modules' watchdog and their ramp."""
    if FAULTS[fault].reaction is Reaction.MODULES_STOP or fault is FaultKind.BUS_OFF:
        return WATCHDOG_S + FOLLOWED_MPS / DRIVE_RAMP_MPS2
    return STOPPED_WITHIN_S
