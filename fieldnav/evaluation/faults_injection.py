"""One way in which a fault occurs in a rig."""

from collections.abc import Callable
from dataclasses import dataclass

from drivers.simulated_module import SimulatedModule
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.faults import FAULTS, FaultKind, Reaction
from fieldnav.messages import Wheel

PASSES_S = 1.2
"""A fault that passes lasts so long: beyond what is borne, within what is held for."""
BROKEN = Wheel.FRONT_LEFT
"""The module that breaks."""

Strike = Callable[[Rig], None]


@dataclass(frozen=True, slots=True)
class Injection:
    """A way in which a fault occurs; passing: for PASSES_S alone.

    also: what it may be called at first; instead: what it may be called as rightly, and be stopped for.

    lasts_s: after so long it is over by itself, and nothing may move for that.
    """

    fault: FaultKind
    strike: Strike
    passes: Strike | None = None
    called: str = ""
    passing: bool = False
    also: frozenset[FaultKind] = frozenset()
    instead: frozenset[FaultKind] = frozenset()
    lasts_s: float = 0.0

    @property
    def name(self) -> str:
        """As pairs are named by it."""
        name = self.called or self.fault.value
        return f"{name} that passes" if self.passing else name

    @property
    def rightly(self) -> frozenset[FaultKind]:
        """What it may be called in the end."""
        return self.instead | {self.fault}

    @property
    def reaction(self) -> Reaction:
        return FAULTS[self.fault].reaction


def broken(rig: Rig) -> SimulatedModule:
    """The module that breaks."""
    return rig.modules.modules[BROKEN]
