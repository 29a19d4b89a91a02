"""One mission through every state; in each, a copy of the process for every fault that is to strike there."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from fieldnav.errors import FieldnavError
from fieldnav.evaluation.faults_copy import CopyError, in_a_copy
from fieldnav.evaluation.faults_cues import cues
from fieldnav.evaluation.faults_injection import Injection
from fieldnav.evaluation.faults_injections import injections
from fieldnav.evaluation.faults_pair import Pair, PairResult
from fieldnav.evaluation.faults_rig import Rig, Setting
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from states.names import Follow, Sidestep, Top, text
from states.names import Path as StatePath
from states.table import IDLE

FIELD, ROBOT = "demo", "bonnbot"
LANES, LENGTH_M = 3, 9.0
"""Two switches, one from a lane driven forward and one from a lane driven backward."""
GAP_FROM_M, GAP_M = 5.0, 1.6
"""In all rows of the first two lanes: there the mission coasts."""
DWELL_S, SHORT_DWELL_S, LONG_DWELL_S = 0.4, 0.06, 1.0
"""The mission has been in a state for so long when a fault strikes."""
SHORT = frozenset({Top.CHECKING, Top.RESUMING, Follow.ACQUIRING, Sidestep.ORIENTING, Sidestep.SAMPLING})
"""States that are over sooner."""
LONG = frozenset({Follow.TRACKING, Top.PAUSED, Top.FAULT})
"""States in which the robot reaches its speed, or comes to rest, only after a while."""
LONGEST_S = 400.0


@dataclass(frozen=True, slots=True)
class Wanted:
    """A pair to be played: the injection's and the leaf's names."""

    injection: str
    leaf: str


@dataclass(frozen=True, slots=True)
class Unplayed:
    """A pair that gave no result, and why."""

    wanted: Wanted
    reason: str


def setting() -> Setting:
    """A short sketched field; vegetation is looked for at half the cameras' size, which costs a quarter."""
    gaps = [{"lane": lane, "start_m": GAP_FROM_M, "length_m": GAP_M} for lane in (1, 2)]
    field = revised(load_field(FIELD), {"lanes": LANES, "length_m": LENGTH_M, "gaps": {"placed": gaps}})
    return Setting(field, load_crop(field.crop), smaller(load_robot(ROBOT)))


def play(wanted: tuple[Wanted, ...]) -> list[PairResult | Unplayed]:
    """Drive once and play these pairs on the way; work of one process. Raises FieldnavError."""
    results: list[PairResult | Unplayed] = []
    with TemporaryDirectory(prefix="fieldnav-") as folder:
        rig = Rig(setting(), Path(folder))
        try:
            for leaf in _visits(rig, {each.leaf for each in wanted}):
                results += [_played(rig, each) for each in wanted if each.leaf == leaf]
        finally:
            rig.close()
    return results


def _visits(rig: Rig, leaves: set[str]) -> Iterator[str]:
    """Each of the leaves once, at a moment within it; the rig drives on after each."""
    left = set(leaves)
    if text(IDLE) in left:
        left.remove(text(IDLE))
        yield text(IDLE)
    rig.mission.start(rig.now_s)
    waiting, since_s, leaf = list(cues()), rig.now_s, rig.leaf
    while left:
        rig.round()
        if rig.leaf != leaf:
            leaf, since_s = rig.leaf, rig.now_s
        here_s = rig.now_s - since_s
        if text(leaf) in left and here_s >= _dwell_s(leaf):
            left.remove(text(leaf))
            yield text(leaf)
        if waiting and waiting[0].leaf == leaf and here_s >= waiting[0].after_s:
            waiting.pop(0).act(rig)
        if rig.now_s > LONGEST_S or rig.broken_off:
            raise FieldnavError(
                f"within {rig.now_s:.0f} s the mission never came to {', '.join(sorted(left))}: "
                f"{rig.paper.lines()[-1].reason}"
            )


def _dwell_s(leaf: StatePath) -> float:
    if SHORT & set(leaf):
        return SHORT_DWELL_S
    return LONG_DWELL_S if LONG & set(leaf) else DWELL_S


def _played(rig: Rig, wanted: Wanted) -> PairResult | Unplayed:
    injection = next(each for each in injections() if each.name == wanted.injection)
    try:
        return in_a_copy(partial(_play_alone, rig, injection))
    except CopyError as error:
        return Unplayed(wanted, str(error))


def _play_alone(rig: Rig, injection: Injection) -> PairResult:
    """In the copy: with papers of its own, and nothing of the original's left open to be written to."""
    with TemporaryDirectory(prefix="fieldnav-") as folder:
        rig.paper.move_to(Path(folder))
        return Pair(rig, injection).play()
