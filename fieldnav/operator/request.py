"""What an operator asks of a running mission, and what the mission answers."""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from typing import Protocol

from fieldnav.operator.status import Status


class Command(Enum):
    """What can be asked; the value is what stands on the line and on the command line."""

    PAUSE = "pause"
    RESUME = "resume"
    STOP = "stop"
    RESET = "reset"
    STATUS = "status"


@dataclass(frozen=True, slots=True)
class Answer:
    """What was done, or with `ok` False why not; the status where it was asked for."""

    ok: bool
    said: str
    status: Status | None = None


@dataclass(frozen=True, slots=True)
class Request:
    """One thing asked; `who` asked it, in words for the journal. It must be answered in the same round."""

    command: Command
    who: str
    answer: Callable[[Answer], None] = field(repr=False, compare=False)

    def reply(self, ok: bool, said: str, status: Status | None = None) -> None:
        """Say what was done, or why not; never raises, and only the first reply counts."""
        self.answer(Answer(ok, said, status))


class Requests(Protocol):
    """Where requests come from; looked at once in every round of the loop."""

    def poll(self, now_s: float) -> tuple[Request, ...]:
        """What has been asked since the last look; never waits and never raises."""
        ...
