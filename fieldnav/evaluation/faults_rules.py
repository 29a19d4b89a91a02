"""What is expected of the pairs, as a table for people: made by asking for every one of them."""

from collections.abc import Sequence
from dataclasses import dataclass

from fieldnav.evaluation.faults_expected import expected
from fieldnav.evaluation.faults_injection import Injection
from fieldnav.faults import Reaction
from states.names import Path, text
from states.table import LANE_LEAVES, LEAVES

LANES, PASSING = "every state of a lane", "what passes"


@dataclass(frozen=True, slots=True)
class Rule:
    """What is expected of faults with one reaction in some states."""

    states: str
    reaction: Reaction
    expected: str


def rules(injections: Sequence[Injection]) -> list[Rule]:
    """By reaction, and within it by what is expected, the states in their order."""
    made = []
    for reaction in Reaction:
        of = [each for each in injections if each.reaction is reaction]
        groups: dict[str, list[Path]] = {}
        for leaf in LEAVES:
            groups.setdefault(_said(leaf, of), []).append(leaf)
        made += [Rule(_named(leaves), reaction, said) for said, leaves in groups.items()]
    return made


def _said(leaf: Path, injections: Sequence[Injection]) -> str:
    """What is expected of all of them there; where it differs, of which."""
    of: dict[str, list[str]] = {}
    for each in injections:
        of.setdefault(expected(leaf, each).value, []).append(PASSING if each.passing else each.name)
    most = max(of, key=lambda said: len(of[said]))
    others = (f"{', '.join(dict.fromkeys(names))}: {said}" for said, names in of.items() if said != most)
    return "; ".join([most, *others])


def _named(leaves: Sequence[Path]) -> str:
    lanes = [leaf for leaf in leaves if leaf in LANE_LEAVES]
    assert len(lanes) in (0, len(LANE_LEAVES)), "the states of lanes are all alike"
    return ", ".join(
        [*(text(leaf) for leaf in leaves if leaf not in LANE_LEAVES), *([LANES] if lanes else [])]
    )
