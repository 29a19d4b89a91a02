"""Every fault in every state: which pairs there are, and how each of them ends, in simulation."""

from collections.abc import Sequence
from dataclasses import dataclass

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Progress
from fieldnav.evaluation.campaign import Failed, run_campaign
from fieldnav.evaluation.faults_drive import Unplayed, Wanted, play
from fieldnav.evaluation.faults_injections import injections
from fieldnav.evaluation.faults_pair import PairResult
from states.names import text
from states.table import LEAVES

PART = "pairs"
DRIVES = 8
"""Missions that the pairs are spread over at least, for progress to be seen."""
AT = "@"
STRIDE = 7
"""In short, the next injection strikes so many states further on: each state once, whatever the number."""


@dataclass(frozen=True, slots=True)
class FaultsPlan:
    """What to play: all pairs, every fault and state at least once, or `only` one pair or some."""

    jobs: int = 1
    quick: bool = False
    only: str = ""


@dataclass(frozen=True, slots=True)
class Played:
    """How the pairs have ended, in the order of the table of faults; and those that gave no result."""

    results: tuple[PairResult, ...]
    unplayed: tuple[Unplayed, ...]

    @property
    def failed(self) -> tuple[PairResult, ...]:
        return tuple(result for result in self.results if result.problem)


def play_all(plan: FaultsPlan, progress: Progress) -> Played:
    """Play the plan's pairs. Raises SettingsError for one that there is not."""
    wanted = pairs(plan)
    drives = 1 if plan.only else plan.jobs if plan.quick else max(plan.jobs, DRIVES)
    shares = [tuple(wanted[drive::drives]) for drive in range(min(drives, len(wanted)))]
    played: dict[Wanted, PairResult | Unplayed] = {}
    for share, outcome in zip(shares, run_campaign(PART, play, shares, plan.jobs, progress), strict=True):
        if isinstance(outcome, Failed):
            played |= {each: Unplayed(each, outcome.reason) for each in share}
        else:
            played |= {_wanted(each): each for each in outcome}
    ended = [played[each] for each in wanted]
    return Played(
        tuple(each for each in ended if isinstance(each, PairResult)),
        tuple(each for each in ended if isinstance(each, Unplayed)),
    )


def pairs(plan: FaultsPlan) -> Sequence[Wanted]:
    """The pairs of a plan. Raises SettingsError."""
    names, leaves = [each.name for each in injections()], [text(leaf) for leaf in LEAVES]
    if plan.only:
        return _named(plan.only, names, leaves)
    if plan.quick:
        # As many as there are injections, which are more than states: both come by in turn.
        return [Wanted(name, leaves[index * STRIDE % len(leaves)]) for index, name in enumerate(names)]
    return [Wanted(name, leaf) for name in names for leaf in leaves]


def _named(only: str, names: Sequence[str], leaves: Sequence[str]) -> Sequence[Wanted]:
    """The pair of 'fault@state', or all of one of the two."""
    name, at, leaf = only.partition(AT)
    if name and name not in names:
        raise SettingsError(f"--only {only}: no fault '{name}'; allowed is one of {', '.join(names)}")
    if (at and not leaf) or (leaf and leaf not in leaves):
        raise SettingsError(f"--only {only}: no state '{leaf}'; allowed is one of {', '.join(leaves)}")
    return [
        Wanted(each, where) for each in ([name] if name else names) for where in ([leaf] if leaf else leaves)
    ]


def _wanted(result: PairResult | Unplayed) -> Wanted:
    return result.wanted if isinstance(result, Unplayed) else Wanted(result.injection, result.leaf)
