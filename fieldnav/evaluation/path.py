"""The true path of a simulated run and the plants it cost, noted tick by tick beside the mission."""

from array import array
from dataclasses import dataclass, field
from math import cos, hypot, sin

import numpy as np

from fieldnav.messages import Floats
from fieldnav.mission.tick import Tick
from fieldnav.simulation.world import World
from states.names import Path as StatePath

CONTACT_HALF_M = 0.06
"""Half the length of a wheel's contact patch: a 0.2 m wheel that sinks in by 1 cm."""
STEM_M = 0.01


def _numbers() -> "array[float]":
    return array("d")


@dataclass(slots=True)
class TruePath:
    """Where the robot was at each tick, in which state, and what it believed of lane and rows.

    Bare numbers are kept in arrays: an hour has 180,000 ticks.
    """

    x_m: "array[float]" = field(default_factory=_numbers)
    y_m: "array[float]" = field(default_factory=_numbers)
    heading_rad: "array[float]" = field(default_factory=_numbers)
    states: list[StatePath] = field(default_factory=list)
    lanes: list[int] = field(default_factory=list)
    rows_passed: list[int] = field(default_factory=list)

    def xy(self) -> Floats:
        """Shape (n, 2)."""
        return np.stack([self.x_m, self.y_m], axis=1)


class PathObserver:
    """Watches the world beside the mission; the mission cannot see it."""

    def __init__(self, world: World) -> None:
        self._world = world
        self.path = TruePath()
        self.run_over: set[int] = set()

    def watch(self, tick: Tick) -> None:
        pose = self._world.now.pose
        self.path.x_m.append(pose.x_m)
        self.path.y_m.append(pose.y_m)
        self.path.heading_rad.append(pose.heading_rad)
        self.path.states.append(tick.state)
        self.path.lanes.append(tick.lane)
        self.path.rows_passed.append(tick.rows_passed)
        self._roll_over()

    def _roll_over(self) -> None:
        """Note the crop plants whose stems the wheels' contact patches touch."""
        world, geometry = self._world, self._world.robot.geometry
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
