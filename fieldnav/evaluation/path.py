"""The true path of a simulated run and the plants it cost, noted tick by tick beside the mission."""

from array import array
from collections.abc import Mapping, MutableSequence
from dataclasses import dataclass, field, fields
from math import cos, hypot, sin, sqrt
from sys import getsizeof

import numpy as np

from fieldnav.messages import Floats, Wheel, WheelSetpoint
from fieldnav.mission.tick import Tick
from fieldnav.simulation.world import World
from states.names import Path as StatePath

CONTACT_HALF_M = 0.06
"""Half the length of a wheel's contact patch: a 0.2 m wheel that sinks in by 1 cm."""
STEM_M = 0.01


def _numbers() -> "array[float]":
    return array("d")


def _counts() -> "array[int]":
    return array("i")


@dataclass(slots=True)
class TruePath:
    """Where the robot was at each tick, how it moved, in which state, and what it believed of lane and rows.

    Bare numbers are kept in arrays: an hour has 180,000 ticks, and takes 12 MB. `steering_rate_rps` is the
    wheels' rms.
    """

    stamp_s: "array[float]" = field(default_factory=_numbers)
    x_m: "array[float]" = field(default_factory=_numbers)
    y_m: "array[float]" = field(default_factory=_numbers)
    heading_rad: "array[float]" = field(default_factory=_numbers)
    yaw_rate_rps: "array[float]" = field(default_factory=_numbers)
    steering_rate_rps: "array[float]" = field(default_factory=_numbers)
    states: list[StatePath] = field(default_factory=list)
    lanes: MutableSequence[int] = field(default_factory=_counts)
    rows_passed: MutableSequence[int] = field(default_factory=_counts)

    @property
    def held_bytes(self) -> int:
        """What all this takes; the states' paths themselves are the table's."""
        return sum(getsizeof(getattr(self, each.name)) for each in fields(self))

    def xy(self) -> Floats:
        """Shape (n, 2)."""
        return np.stack([self.x_m, self.y_m], axis=1)


class PathObserver:
    """Watches the world beside the mission; the mission cannot see it."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.path = TruePath()
        self.run_over: set[int] = set()
        self._steering: tuple[float, Mapping[Wheel, WheelSetpoint]] | None = None

    def watch(self, tick: Tick) -> None:
        pose = self.world.now.pose
        self.path.stamp_s.append(tick.now_s)
        self.path.x_m.append(pose.x_m)
        self.path.y_m.append(pose.y_m)
        self.path.heading_rad.append(pose.heading_rad)
        self.path.yaw_rate_rps.append(self.world.now.twist.yaw_rate_rps)
        self.path.steering_rate_rps.append(self._steering_rate(tick.now_s))
        self.path.states.append(tick.state)
        self.path.lanes.append(tick.lane)
        self.path.rows_passed.append(tick.rows_passed)
        self._roll_over()

    def _steering_rate(self, now_s: float) -> float:
        """Root mean square over the wheels since the tick before."""
        before, wheels = self._steering, self.world.wheels()
        self._steering = now_s, wheels
        if before is None or now_s <= before[0]:
            return 0.0
        turned = [state.steering_rad - before[1][wheel].steering_rad for wheel, state in wheels.items()]
        return sqrt(sum(turn * turn for turn in turned) / len(turned)) / (now_s - before[0])

    def _roll_over(self) -> None:
        """Note the crop plants whose stems the wheels' contact patches touch."""
        world, geometry = self.world, self.world.robot.geometry
        pose, plants = world.now.pose, world.plan.plants
        c, s = cos(pose.heading_rad), sin(pose.heading_rad)
        half_width_m = geometry.wheel_width_m / 2 + STEM_M
        reach_m = hypot(CONTACT_HALF_M, half_width_m)
        for wheel, state in world.wheels().items():
            x, y = geometry.position_m(wheel)
            at = (pose.x_m + c * x - s * y, pose.y_m + s * x + c * y)
            near = world.plan.plants_near(at, reach_m)
            if not len(near):
                continue
            away_x, away_y = plants.x_m[near] - at[0], plants.y_m[near] - at[1]
            turn = pose.heading_rad + state.steering_rad
            along = away_x * cos(turn) + away_y * sin(turn)
            across = away_y * cos(turn) - away_x * sin(turn)
            under = (np.abs(along) <= CONTACT_HALF_M) & (np.abs(across) <= half_width_m)
            self.run_over.update(int(index) for index in near[under & plants.is_crop[near]])
