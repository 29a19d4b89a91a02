"""What happened in one tick of the loop, for those who watch: journal pictures, figures, the live line."""

from dataclasses import dataclass
from typing import Protocol

from fieldnav.mission.gate import Passed
from states.behaviour import Step
from states.machine import Change
from states.names import Path


@dataclass(frozen=True, slots=True)
class Tick:
    """What happened in one tick, for those who watch.

    reason: why the state was changed last; warning: what a person should know from this tick on.
    """

    now_s: float
    state: Path
    change: Change | None
    step: Step
    passed: Passed
    lane: int
    rows: int
    rows_passed: int
    forward_m: float
    sideways_m: float
    warning: str = ""
    reason: str = ""


class Observer(Protocol):
    """Watches the mission; what it does has no way back into it."""

    def watch(self, tick: Tick) -> None: ...
