"""A robot that is led along a lane of plants, and what its wheels and cameras say of it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from math import atan, cos, sin, tan
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.estimation.lane_path import LanePath
from fieldnav.estimation.lane_state import LaneState
from fieldnav.estimation.sighting import Sighting
from fieldnav.messages import Floats
from fieldnav.odometry import Pose
from fieldnav.perception.follow import scatter_m, widest_m
from fieldnav.perception.lane import comb_m
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop

STEP_M = 0.05
VIEW_M, VIEW_HALF_M = (0.85, 1.75), 0.95
CAMERA_M = 0.75
SHAKE_M, SHAKES_PER_M = 0.02, 2.8
"""A degree of roll one metre up, 1.4 times a second at half a metre a second."""
WANDER_M, WANDER_LENGTH_M = 0.04, 5.0
"""The robot is not held on the lane: it wanders about it by so much."""


@dataclass(frozen=True)
class Lane:
    """A lane of constant curvature from the origin along x, to be asked for poses on it."""

    curvature_per_m: float = 0.0

    def pose(self, s_m: float, left_m: float = 0.0, turned_rad: float = 0.0) -> Pose:
        k = self.curvature_per_m
        angle = k * s_m
        x, y = (sin(angle) / k, (1 - cos(angle)) / k) if k else (s_m, 0.0)
        return Pose(x - left_m * sin(angle), y + left_m * cos(angle), angle + turned_rad)

    def places(self, s_m: Floats, left_m: Floats) -> Floats:
        poses = [self.pose(s, left) for s, left in zip(s_m, left_m, strict=True)]
        return np.array([[pose.x_m, pose.y_m] for pose in poses]).reshape(-1, 2)


@dataclass(frozen=True)
class Pushed:
    """How the robot moves beyond what its wheels say, for each metre; and random walks over one metre."""

    sideslip: float = 0.0
    yaw_per_m: float = 0.0
    aside_sd_m: float = 0.0
    turn_sd_rad: float = 0.0


@dataclass
class Walk:
    """Leads the robot along a lane; keeps its true place, what its wheels say, and the estimate."""

    lane: Lane
    plants_m: Floats
    weight: Floats
    path: LanePath
    pushed: Pushed = Pushed()
    camera_aside_rad: float = 0.0
    mirror: int = 1
    shakes: bool = True
    reach_m: float = 0.12
    s_m: float = 0.0
    reckoned: Pose = field(default_factory=Pose)
    random: np.random.Generator = field(default_factory=lambda: np.random.default_rng(0))

    @property
    def left_m(self) -> float:
        return self.mirror * WANDER_M * sin(2 * np.pi * self.s_m / WANDER_LENGTH_M)

    @property
    def turned_rad(self) -> float:
        slope = WANDER_M * 2 * np.pi / WANDER_LENGTH_M * cos(2 * np.pi * self.s_m / WANDER_LENGTH_M)
        return self.mirror * atan(slope)

    @property
    def true(self) -> Pose:
        return self.lane.pose(self.s_m, self.left_m, self.turned_rad)

    def drive(self, distance_m: float, looks: Callable[[int], bool] = lambda frame: True) -> Iterator[float]:
        """Go on frame by frame; `looks` tells which frames show anything. Yields s after each."""
        for frame in range(round(distance_m / STEP_M)):
            self._move()
            self.path.carry(self.reckoned)
            if looks(frame):
                self.path.see(self.sighting())
            yield self.s_m

    def _move(self) -> None:
        before = self.true
        self.s_m += STEP_M
        after, pushed = self.true, self.pushed
        ahead, left = beside(np.array([[after.x_m, after.y_m]]), before)[0]
        turn = after.heading_rad - before.heading_rad
        aside_m, turn_rad = self.random.normal(0, [pushed.aside_sd_m, pushed.turn_sd_rad]) * STEP_M**0.5
        left -= pushed.sideslip * ahead + aside_m
        turn -= pushed.yaw_per_m * ahead + turn_rad
        c, s = cos(self.reckoned.heading_rad), sin(self.reckoned.heading_rad)
        now = self.reckoned
        self.reckoned = Pose(
            now.x_m + ahead * c - left * s, now.y_m + ahead * s + left * c, now.heading_rad + turn
        )

    def sighting(self) -> Sighting:
        """The plants in view, shaken, by a camera that may look aside."""
        points = beside(self.plants_m, self.true)
        inside = (
            (points[:, 0] > VIEW_M[0]) & (points[:, 0] < VIEW_M[1]) & (np.abs(points[:, 1]) < VIEW_HALF_M)
        )
        seen = points[inside]
        roll_m = self.mirror * self.shakes * SHAKE_M * 2**0.5 * sin(2 * np.pi * SHAKES_PER_M * self.s_m)
        aside_m = roll_m + (seen[:, 0] - CAMERA_M) * tan(self.camera_aside_rad)
        seen = seen + np.stack([np.zeros(len(seen)), aside_m], axis=-1)
        return Sighting(seen, np.full(len(seen), self.reach_m), self.weight[inside])

    def state(self) -> LaneState:
        return self.path.state(self.reckoned)

    def error_m(self) -> float:
        return self.state().offset_m - self.left_m


def beside(points_m: Floats, pose: Pose) -> Floats:
    """Points in the frame of a pose, shape (n, 2)."""
    c, s = cos(pose.heading_rad), sin(pose.heading_rad)
    return np.asarray((points_m - [pose.x_m, pose.y_m]) @ np.array([[c, -s], [s, c]]))


def stand(
    crop: CropProfile, lane: Lane, length_m: float, random: np.random.Generator, shift_m: Floats | float = 0.0
) -> tuple[Floats, Floats]:
    """Plants of a lane, shape (n, 2), and the row each is in; `shift_m` moves each row in the lane."""
    along = np.arange(-1.0, length_m + 2.5, crop.plants.spacing_m)
    places = comb_m(crop) + shift_m
    row = np.repeat(np.arange(len(places)), len(along))
    s = np.tile(along, len(places)) + random.normal(0, 0.01, len(row))
    left = places[row] + random.normal(0, 0.015, len(row))
    return lane.places(s, left), row


def first_look(crop: CropProfile, lane: Lane, true: Pose, wrong: tuple[float, float]) -> LanePath:
    """A path begun from a look at the lane's tangent in the view, wrong by an offset and an angle."""
    middle = lane.pose(sum(VIEW_M) / 2)
    x, y = beside(np.array([[middle.x_m, middle.y_m]]), true)[0]
    slope = tan(middle.heading_rad - true.heading_rad + wrong[1])
    return LanePath(Pose(), y - slope * x + wrong[0], slope, comb_m(crop), scatter_m(crop), VIEW_M[1])


def walk(
    crop: CropProfile,
    length_m: float,
    seed: int,
    curvature_per_m: float = 0.0,
    shift_m: Floats | float = 0.0,
    wrong: tuple[float, float] = (0.0, 0.0),
    mirror: int = 1,
    **more: object,
) -> Walk:
    """A walk along a lane of a crop; `mirror` -1 exchanges left and right of everything."""
    random, lane = np.random.default_rng(seed), Lane(curvature_per_m)
    plants, _ = stand(crop, lane, length_m, random, shift_m)
    reach = min(crop.plants.canopy_width_m / 2 + 0.02, widest_m(crop))
    mirrored = Lane(mirror * curvature_per_m)
    turned = Pose(0.0, 0.0, mirror * atan(WANDER_M * 2 * np.pi / WANDER_LENGTH_M))
    path = first_look(crop, mirrored, turned, (mirror * wrong[0], mirror * wrong[1]))
    plants = plants * [1, mirror]
    made = Walk(mirrored, plants, np.ones(len(plants)), path, mirror=mirror, reach_m=reach, random=random)
    for name, value in more.items():
        setattr(made, name, value)
    return made


@pytest.fixture(scope="session")
def led() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    crop = load_crop("sugar-beet")
    return SimpleNamespace(crop=crop, walk=walk, stand=stand, Lane=Lane, Pushed=Pushed, view_m=VIEW_M)
