"""The course of a mission: its state, fired here alone, and written down before the wheels obey."""

from collections.abc import Iterable
from dataclasses import replace

from fieldnav.journal.ledger import Ledger
from fieldnav.mission.bookkeeping import Bookkeeping
from fieldnav.mission.chronicle import Chronicle, Recorded
from fieldnav.mission.tick import Observer
from fieldnav.mission.travel import Travel
from fieldnav.operator.confirmation import Confirmations
from states.behaviour import Step, Task
from states.behaviours import Behaviours
from states.machine import Change, MissionMachine
from states.names import Event, Path
from states.place import Place
from states.table import FINISHED, LANE_LEAVES, LATCHED, RECOVERABLE


class Course:
    """Machine, behaviours, journal and ledger of one mission; `ended_s`: since when it waits for a person."""

    def __init__(
        self,
        task: Task,
        travel: Travel,
        journal: Recorded,
        observers: Iterable[Observer],
        ledger: Ledger | None,
        confirmations: Confirmations | None,
    ) -> None:
        self.machine, self.behaviours = MissionMachine(), Behaviours(task)
        self.chronicle = Chronicle(journal, observers, self.behaviours, travel)
        self.books = Bookkeeping(ledger, task, self.behaviours, travel)
        self.confirmations = confirmations or Confirmations()
        self.ended_s: float | None = None
        self._travel = travel

    @property
    def leaf(self) -> Path:
        return self.machine.leaf

    @property
    def moving(self) -> bool:
        """Whether the wheels may move in the present state."""
        return self.machine.leaf in LANE_LEAVES

    def resume_from(self, place: Place) -> None:
        """Take up a mission that was broken off; what is seen must fit before anything moves."""
        self.behaviours.resume(place)
        self._travel.forward_m, self._travel.sideways_m = place.forward_m, place.sideways_m
        self.books.newest = place

    def go(self, now_s: float, step: Step) -> Change:
        """Fire, write it down, take up the new state: journal and ledger are on the disk when it returns."""
        assert step.event is not None, "only an event changes the state"
        self.machine.expected = self.behaviours.lane.resumes
        change = self.machine.fire(step.event)
        self.chronicle.changed(now_s, change, step)
        self._enter(now_s, change)
        return change

    def brought(self, now_s: float, change: Change) -> None:
        """Take over a transition that another mission has made; only a replay does this."""
        self.machine.bring(change.target)
        self._enter(now_s, change)

    def _enter(self, now_s: float, change: Change) -> None:
        self.behaviours.enter(change)
        self.books.book(now_s, change.target)
        self.ended_s = now_s if change.target in (FINISHED, RECOVERABLE, LATCHED) else None

    def asked(self, step: Step) -> Step:
        """The step; a pause with a question instead where a person must say yes first."""
        if step.event in (Event.ROWS_SEEN_AGAIN, Event.LANE_CENTRED):
            self.confirmations.withdraw()  # what was said yes to is past
        if step.event is None or not self.confirmations.asks(step.event):
            return step
        return replace(step, event=Event.PAUSE, reason=self.confirmations.question)
