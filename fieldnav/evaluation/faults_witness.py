"""What is seen of a rig from outside while a fault is on: wheels, commands, sight, path, journal."""

from dataclasses import dataclass
from math import hypot, inf, nan

from fieldnav.evaluation.faults_injection import Injection
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.faults import FaultKind
from fieldnav.journal.entry import Line
from fieldnav.messages import CameraName, Twist
from fieldnav.mission.picture_watch import FROZEN_M
from states.names import Follow, Path, Phase
from states.table import LANE_LEAVES

STANDS_MPS = 0.01
"""A wheel that turns slower stands."""
LOOKED_EVERY = 5
"""Rounds between two looks at where the robot is."""
PAST_M = 0.5
"""Driven until pictures of the past must be found out."""
ROUNDING_S = 1e-6


@dataclass(frozen=True, slots=True)
class Moment:
    """One round: what was wanted and let through, in m/s, and whether every module was told to stand."""

    now_s: float
    leaf: Path
    guides: tuple[CameraName, ...]
    wanted_mps: float
    passed_mps: float
    told_zero: bool


class Witness:
    """Notes from its making on what a rig does."""

    def __init__(self, rig: Rig, injection: Injection) -> None:
        self._rig, self._injection = rig, injection
        self.struck_s, self.leaf = rig.now_s, rig.leaf
        self._begun_at, self._lines = rig.world.now.pose, len(rig.paper.lines())
        self._run_over, self._commands = len(rig.path.run_over), rig.bus.commands
        self.moments: list[Moment] = []
        self.stale_commands = 0
        self.offset_m = 0.0
        self.speed_mps = self.fastest_mps
        self._moving = self.speed_mps > STANDS_MPS
        self._changes: list[tuple[float, bool]] = []
        rig.world.after_step.append(self._look_at_wheels)
        rig.after.append(self._note)

    @property
    def fastest_mps(self) -> float:
        return max(abs(wheel.speed_mps) for wheel in self._rig.world.wheels().values())

    @property
    def run_over(self) -> int:
        """Crop plants run over since the fault struck."""
        return len(self._rig.path.run_over) - self._run_over

    def lines(self) -> list[Line]:
        """The journal since the fault struck."""
        return self._rig.paper.lines()[self._lines :]

    def noticed(self, kinds: frozenset[FaultKind]) -> Line | None:
        """The journal's first line that names one of these faults."""
        return next((line for line in self.lines() if names(line, kinds)), None)

    def zero_after_s(self, since_s: float) -> float:
        """From then until every module has been told to stand; NaN where that never came."""
        told = (each.now_s for each in self.moments if each.told_zero and each.now_s >= since_s - ROUNDING_S)
        return max(0.0, next(told, nan) - since_s)

    def standing_after_s(self, since_s: float) -> float:
        """From then until all true wheels stand; NaN where they never did."""
        moving = self._moving_at(since_s)
        if not moving:
            return 0.0
        stops = (at_s for at_s, moves in self._changes if at_s > since_s and not moves)
        return next(stops, nan) - since_s

    def stood_throughout(self) -> bool:
        return not self._moving and not self._changes

    @property
    def stands(self) -> bool:
        return not (self._changes[-1][1] if self._changes else self._moving)

    def _moving_at(self, at_s: float) -> bool:
        before = [moves for changed_s, moves in self._changes if changed_s <= at_s]
        return before[-1] if before else self._moving

    def _look_at_wheels(self) -> None:
        moves = self.fastest_mps > STANDS_MPS
        if moves == self.stands:
            self._changes.append((self._rig.world.now.stamp_s, moves))

    def _note(self) -> None:
        rig, tick = self._rig, self._rig.newest.tick
        wanted, passed = (tick.step.motion.twist, tick.passed.motion.twist) if tick else (Twist(), Twist())
        moment = Moment(rig.now_s, rig.leaf, rig.guided_by, _mps(wanted), _mps(passed), rig.told_zero)
        self.moments.append(moment)
        commanded, self._commands = rig.bus.commands > self._commands, rig.bus.commands
        if commanded and not rig.told_zero and self._stale():
            self.stale_commands += 1
        if len(self.moments) % LOOKED_EVERY == 0:
            self._look_where()

    def _stale(self) -> bool:
        """Whether the newest good frame that guides is too old; a frozen picture must first be found out."""
        rig = self._rig
        ages = [rig.now_s - (rig.cameras[name].good_s or -inf) for name in rig.guided_by]
        if max(ages, default=0.0) <= rig.robot.timeouts.frame_s + ROUNDING_S:
            return False
        return self._driven_m() > self._allowed_m()

    def _driven_m(self) -> float:
        here = self._rig.world.now.pose
        return hypot(here.x_m - self._begun_at.x_m, here.y_m - self._begun_at.y_m)

    def _allowed_m(self) -> float:
        """Driven until a lie is found out, two frames, and what a good one is gone by for; else nothing."""
        robot = self._rig.robot
        seconds = robot.timeouts.frame_s + 2 / robot.cameras.front.rate_hz
        gone_by_m = self._rig.crop.speeds.follow_mps * seconds
        if self._injection.fault is FaultKind.CAMERA_FROZEN:
            return FROZEN_M + gone_by_m
        if self._injection.fault is not FaultKind.CAMERA_PAST:
            return 0.0
        # Without rows in view the robot goes by its wheels alone, and its profile says how far.
        coasting = Follow.COASTING in self.leaf
        return PAST_M + (self._rig.crop.row_end.longest_gap_m if coasting else 0.0)

    def _look_where(self) -> None:
        """How far from the middle of the lane the robot is, while it follows or leaves one."""
        rig = self._rig
        leaf = rig.leaf if rig.leaf in LANE_LEAVES else self.leaf
        if not {Phase.FOLLOW, Phase.EXIT} & set(leaf):
            return
        pose, plan = rig.world.now.pose, rig.world.plan
        offsets = [abs(float(plan.in_lane(lane, (pose.x_m, pose.y_m))[1])) for lane in plan.sown_lanes]
        self.offset_m = max(self.offset_m, min(offsets))


def names(line: Line, kinds: frozenset[FaultKind]) -> bool:
    """Whether a line of the journal names one of these faults."""
    return any(line.event == kind.value or line.reason.startswith(f"{kind.value}:") for kind in kinds)


def _mps(twist: Twist) -> float:
    return hypot(twist.vx_mps, twist.vy_mps)
