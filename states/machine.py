"""The state machine: the table, run by the `transitions` package. One thread fires it."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import Enum
from functools import partial
from typing import Any

from transitions import MachineError
from transitions.extensions import HierarchicalMachine

from states.names import Event, Path
from states.table import CHECKING, IDLE, LANE_LEAVES, LEAVES, RESUMING, TRANSITIONS

SEPARATOR = "_"  # of the transitions package; no name in the table contains it
RESUMABLE = (CHECKING, RESUMING, *LANE_LEAVES)


@dataclass(frozen=True, slots=True)
class Change:
    """A transition that was made, leaf to leaf."""

    source: Path
    event: Event
    target: Path


class _Model:
    """What the transitions package hangs its state and triggers on."""

    state: str
    trigger: Any
    may_trigger: Any


class MissionMachine:
    """Holds the mission's state; remembers where a pause or a fault interrupted it.

    `expected`: where a mission that was broken off is to go on, once what is seen fits its ledger.
    """

    def __init__(self) -> None:
        self._model = _Model()
        self._interrupted: Path | None = None
        self.expected: Path | None = None
        self._machine = HierarchicalMachine(
            model=self._model,
            states=_nested(LEAVES),
            transitions=list(self._rows()),
            initial=_key(IDLE),
            auto_transitions=False,
        )

    @property
    def leaf(self) -> Path:
        return _LEAF_OF[self._model.state]

    def may(self, event: Event) -> bool:
        """Whether the event leads anywhere from the present state."""
        return bool(self._model.may_trigger(event.name))

    def fire(self, event: Event) -> Change:
        """Make the transition; raises transitions.MachineError when there is none from here."""
        source = self.leaf
        if not self._model.trigger(event.name):
            raise MachineError(f"{event.value}: nothing is known of where to go on")
        if event in (Event.PAUSE, Event.FAIL) and source in RESUMABLE:
            self._interrupted = source
        elif event in (Event.RESET, Event.RESUME):
            self._interrupted = None
        return Change(source, event, self.leaf)

    def bring(self, leaf: Path) -> None:
        """Stand in a leaf without any event: in a replay, where the recorded mission stood."""
        if leaf not in RESUMABLE and self.leaf in RESUMABLE:
            self._interrupted = self.leaf
        self._machine.set_state(_key(leaf))

    def _goes_on(self, event: Event, leaf: Path) -> bool:
        return leaf == (self._interrupted if event is Event.RESUME else self.expected)

    def _rows(self) -> Iterator[dict[str, Any]]:
        for row in TRANSITIONS:
            base = {"trigger": row.event.name, "source": _key(row.source)}
            if row.target is not None:
                yield {**base, "dest": _key(row.target)}
                continue
            for leaf in RESUMABLE:
                yield {**base, "dest": _key(leaf), "conditions": partial(self._goes_on, row.event, leaf)}


def _key(path: Path) -> str:
    """A state's name within the transitions package."""
    return SEPARATOR.join(str(member.value) for member in path)


_LEAF_OF = {_key(leaf): leaf for leaf in LEAVES}


def _nested(paths: Iterable[Path]) -> list[dict[str, Any]]:
    """The leaves as the nested dictionaries that the transitions package wants."""
    children: dict[Enum, list[Path]] = {}
    for head, *rest in paths:
        below = children.setdefault(head, [])
        if rest:
            below.append(tuple(rest))
    return [{"name": head.value, "children": _nested(below)} for head, below in children.items()]
