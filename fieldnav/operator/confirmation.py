"""The transitions that the robot may not make before a person has said yes."""

from collections.abc import Iterable
from enum import Enum

from fieldnav.errors import SettingsError
from states.names import Event


class Confirmation(Enum):
    """A word of `--confirm`: what must be confirmed."""

    SWITCH = "switch"
    EXIT = "exit"


EVENTS = {Confirmation.SWITCH: Event.LANE_LEFT, Confirmation.EXIT: Event.LANE_ENDED}
"""The event that each word asks about."""

QUESTIONS = {
    Event.LANE_LEFT: "the lane is left: switch to the next one?",
    Event.LANE_ENDED: "the lane has ended: leave it?",
}
YES = "resume says yes"


def parse_confirmations(words: str, option: str = "--confirm") -> frozenset[Event]:
    """The events to be asked about, of words with commas between; none of an empty text.

    Raises SettingsError.
    """
    allowed = {word.value: EVENTS[word] for word in Confirmation}
    given = [word.strip() for word in words.split(",")] if words.strip() else []
    for word in given:
        if word not in allowed:
            choice = ", ".join(allowed)
            raise SettingsError(f"{option}: '{word}': allowed are {choice}, with a comma between")
    return frozenset(allowed[word] for word in given)


class Confirmations:
    """What must be asked, what has been asked, and the one yes that has been given."""

    def __init__(self, events: Iterable[Event] = ()) -> None:
        self._events = frozenset(events)
        self._open: Event | None = None
        self._granted: Event | None = None

    @property
    def question(self) -> str:
        """What the mission waits for an answer to; empty when it does not."""
        return f"{QUESTIONS[self._open]} {YES}" if self._open is not None else ""

    def asks(self, event: Event) -> bool:
        """Whether the event must be asked about; then the question is open. A yes is used up by it."""
        if event not in self._events:
            return False
        if event is self._granted:
            self.withdraw()
            return False
        self._open, self._granted = event, None
        return True

    def grant(self) -> bool:
        """Say yes to the open question: its event is let through once. False when nothing was asked."""
        if self._open is None:
            return False
        self._granted, self._open = self._open, None
        return True

    def withdraw(self) -> None:
        """Forget the question and the yes: what was asked about has not come, or the mission begins anew."""
        self._open = self._granted = None
