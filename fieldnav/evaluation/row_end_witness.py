"""What is noted of a lane as it is driven: what happened and where, the states, the cross-track error."""

from array import array
from collections import defaultdict
from dataclasses import dataclass, field

import numpy as np

from fieldnav.mission.loop import TICK_S
from fieldnav.mission.tick import Tick
from fieldnav.simulation.world import World
from states.names import Event, Follow, Path, Phase

LANE = 0  # the only lane that is driven
NOTED_EVERY = 10  # ticks: 0.1 m at working speed


@dataclass(frozen=True, slots=True)
class Happening:
    """An event at a place s of the robot's centre along the lane, and what it was judged by."""

    event: Event
    s_m: float
    reason: str
    evidence: tuple[tuple[str, float], ...]


@dataclass(slots=True)
class Notes:
    """Of one lane; offset_m are true distances from the lane's middle while following."""

    happenings: list[Happening] = field(default_factory=list)
    seconds: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float))
    offset_m: "array[float]" = field(default_factory=lambda: array("d"))


class Witness:
    """Watches a mission in the world's first lane."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._ticks = 0
        self.notes = Notes()

    def watch(self, tick: Tick) -> None:
        self._ticks += 1
        self.notes.seconds[str(tick.state[-1].value)] += TICK_S
        if tick.change is not None:
            evidence = tuple((each.name, each.value) for each in tick.step.evidence)
            s_m, _ = self._place()
            self.notes.happenings.append(Happening(tick.change.event, s_m, tick.step.reason, evidence))
        if self._ticks % NOTED_EVERY == 0 and _following(tick.state):
            self.notes.offset_m.append(self._place()[1])

    def place_m(self) -> float:
        """s of the robot's centre."""
        return self._place()[0]

    def _place(self) -> tuple[float, float]:
        pose = self._world.now.pose
        s, offset, _ = self._world.plan.in_lane(LANE, np.array([pose.x_m, pose.y_m]))
        return float(s), float(offset)


def _following(state: Path) -> bool:
    return Phase.FOLLOW in state and state[-1] is not Follow.ACQUIRING
