"""What the loop does, written down in the journal and told to those who watch."""

from collections.abc import Iterable
from typing import Protocol

from fieldnav.journal.entry import Entry
from fieldnav.messages import STANDSTILL
from fieldnav.mission.gate import Passed
from fieldnav.mission.tick import Observer, Tick
from fieldnav.mission.travel import Travel
from states.behaviour import Step
from states.behaviours import Behaviours
from states.machine import Change
from states.names import Path, text
from states.table import LANE_LEAVES

OBSERVER_LOST = "observer lost"
APART_S = 1.0
"""Holds that follow each other sooner are one: each line costs a write to the disk. Our choice."""


class Recorded(Protocol):
    """Where entries are kept: a journal, or in a replay a list."""

    def record(self, entry: Entry) -> None:
        """On return the entry is kept for good. Raises OutputError."""
        ...


class Chronicle:
    """Keeps the journal; an observer that fails is let go, and the journal says so."""

    def __init__(
        self, journal: Recorded, observers: Iterable[Observer], behaviours: Behaviours, travel: Travel
    ) -> None:
        self._journal, self._observers = journal, list(observers)
        self._behaviours, self._travel = behaviours, travel
        self._held_in: Path | None = None
        self._held_s = 0.0
        self._because = ""

    def changed(self, now_s: float, change: Change, step: Step) -> None:
        """Write down a transition, and the step that asked for it."""
        self._because = step.reason
        self._record(now_s, change.event.value, change.source, change.target, step)

    def held(self, now_s: float, leaf: Path, passed: Passed) -> None:
        """Write down that the gate begins to hold the wheels although the state wants to move."""
        if passed.refused is None:
            return
        again = self._held_in == leaf and now_s - self._held_s < APART_S
        self._held_in, self._held_s = leaf, now_s
        if not again:
            self.noted(now_s, "held by the gate", leaf, Step(reason=passed.reason))

    def noted(self, now_s: float, event: str, leaf: Path, step: Step) -> None:
        """Write down what changes no state."""
        self._record(now_s, event, leaf, leaf, step)

    def tell(
        self, now_s: float, leaf: Path, change: Change | None, step: Step, passed: Passed, warning: str = ""
    ) -> None:
        """Let every observer watch this tick, which ended in the leaf."""
        lane = self._behaviours.lane
        tick = Tick(
            now_s=now_s,
            state=leaf,
            change=change,
            step=step,
            passed=passed,
            lane=lane.number,
            rows=lane.rows,
            rows_passed=lane.rows_passed,
            forward_m=self._travel.forward_m,
            sideways_m=self._travel.sideways_m,
            pose=self._travel.pose,
            report=self._travel.report,
            warning=warning,
            reason=self._because,
        )
        for observer in tuple(self._observers):
            self._show(observer, tick)

    def _show(self, observer: Observer, tick: Tick) -> None:
        try:
            observer.watch(tick)
        except Exception as error:  # who only watches may not stop the mission
            self._observers.remove(observer)
            reason = f"{type(observer).__name__} watches no longer: {type(error).__name__}: {error}"
            self.noted(tick.now_s, OBSERVER_LOST, tick.state, Step(reason=reason))

    def _record(self, now_s: float, event: str, source: Path, target: Path, step: Step) -> None:
        lane = self._behaviours.lane
        entry = Entry(
            stamp_s=now_s,
            event=event,
            source=text(source),
            target=text(target),
            lane=lane.number,
            rows=lane.rows,
            evidence=step.evidence,
            frame=step.sight.frame if step.sight else None,
            command=step.motion.twist if target in LANE_LEAVES else STANDSTILL,
            reason=step.reason,
            forward_m=self._travel.forward_m,
            sideways_m=self._travel.sideways_m,
        )
        self._journal.record(entry)
