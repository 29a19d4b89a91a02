"""What a served robot truly did: its path beside the field, judged as a simulated run's is."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fieldnav.evaluation.path import PathObserver
from fieldnav.evaluation.truth import judge
from fieldnav.journal.summary import Truth
from fieldnav.messages import Direction, Floats, Motion
from fieldnav.mission.gate import Passed
from fieldnav.mission.tick import Tick
from fieldnav.odometry import Pose
from fieldnav.simulation.plan import FieldPlan
from fieldnav.simulation.world import World
from states.behaviour import Step
from states.names import Follow, Phase

NOTE_S = 0.02
"""Between two notes, as between two ticks of a mission."""
FOLLOWING = (Direction.FORWARD, Phase.FOLLOW, Follow.TRACKING)
"""What drives the robot does not say what it is doing: all that lies within the rows counts as following."""


@dataclass(frozen=True, slots=True)
class Account:
    """How it ended: the figures against the truth, the way driven, where the robot stands."""

    truth: Truth
    distance_m: float
    pose: Pose


class Witness:
    """Notes the true path while the robot moves; call `note` after each step of the world."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._observer = PathObserver(world)
        self._due_s = 0.0
        self._noted: Pose | None = None

    def note(self) -> None:
        """Keep where the robot is, unless it is too soon or the robot still stands where it was."""
        now = self._world.now
        if now.stamp_s < self._due_s or now.pose == self._noted:
            return
        self._due_s, self._noted = now.stamp_s + NOTE_S, now.pose
        self._observer.watch(
            Tick(
                now_s=now.stamp_s,
                state=FOLLOWING,
                change=None,
                step=Step(),
                passed=Passed(Motion(), {}),
                lane=0,
                rows=0,
                rows_passed=0,
                forward_m=0.0,
                sideways_m=0.0,
            )
        )

    def account(self, lanes: int) -> Account:
        """Judge what was driven; `lanes` were to be."""
        xy = self._observer.path.xy()
        self._observer.path.lanes = passes(self._world.plan, xy).tolist()
        way_m = float(np.hypot(*np.diff(xy, axis=0).T).sum())
        return Account(judge(self._world, self._observer, lanes), way_m, self._world.now.pose)


def passes(plan: FieldPlan, xy: Floats) -> NDArray[np.int64]:
    """Which drive through a lane each place (n, 2) of a path belongs to, counted from 1.

    Another one begins where the robot comes in from beyond the rows, or from another lane.
    """
    places = [plan.in_lane(lane, xy) for lane in plan.sown_lanes]
    which = np.abs(np.stack([offset_m for _, offset_m, _ in places])).argmin(axis=0)
    s_m = np.stack([along_m for along_m, _, _ in places])[which, np.arange(len(which))]
    first_m, last_m = np.array([plan.lane_span_m(lane) for lane in plan.sown_lanes])[which].T
    within = np.where((s_m >= first_m) & (s_m <= last_m), which, -1)
    entered = (within != np.concatenate([[-1], within])[:-1]) & (within >= 0)
    return np.asarray(np.cumsum(entered), dtype=np.int64)
