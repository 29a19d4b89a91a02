"""A robot that drives a drawn field: it sees by both cameras what stands about it, and obeys its states."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import pi, radians, tan
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.messages import CameraName, Direction, Floats, Frame, Image, Side, Twist
from fieldnav.odometry import Pose
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.lane import comb_m
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import ControlLaw, CropProfile
from fieldnav.settings.loading import load_crop
from states.acquiring import Acquiring
from states.behaviour import Behaviour, Observation, Step, Task
from states.coasting import Coasting
from states.exiting import Exiting
from states.memory import LaneMemory
from states.names import Event
from states.tracking import Tracking

SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
LEAF = 0.4
"""Radius of a drawn plant over the canopy's width."""
TICK_S, FRAME_TICKS = 1 / 15, 3
CAMERA = Pinhole(320, 180, 160 / tan(radians(69) / 2), 1.0, radians(65), 0.75)
NEAREST_M, FURTHEST_M = 0.6, 2.1
"""Plants that reach into the picture stand this far ahead of the robot's centre."""
SEED = 5
LONGEST_S = 90.0
"""No drive of these tests takes longer."""

STATES = {"acquiring": Acquiring, "tracking": Tracking, "coasting": Coasting, "exiting": Exiting}
NEXT: dict[Event, str] = {
    Event.ROWS_FOUND: "tracking",
    Event.ROWS_LOST: "coasting",
    Event.ROWS_SEEN_AGAIN: "coasting",
    Event.LANE_ENDED: "exiting",
}
"""The part of the table that follows a lane."""


@dataclass
class Robot:
    """Drives along the field's x, forward or backward; `true` is where it is, `reckoned` where it thinks."""

    task: Task
    direction: Direction
    plants_m: Floats
    memory: LaneMemory
    true: Pose
    sideslip: float = 0.0
    reckoned: Pose = field(default_factory=Pose)
    then: Pose = field(init=False)
    then_reckoned: Pose = field(init=False)
    now_s: float = 0.0
    ticks: int = 0
    forward_m: float = 0.0
    passed: list[tuple[float, str, Step]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.then, self.then_reckoned = self.true, self.reckoned

    @property
    def s_m(self) -> float:
        return self.true.x_m

    @property
    def left_m(self) -> float:
        """To the left of the lane, looking in the direction of travel."""
        return self.true.y_m

    @property
    def trailing_camera_m(self) -> float:
        return self.s_m - CAMERA.forward_m

    def picture(self, name: CameraName, pose: Pose) -> Image:
        """What a camera sees from a pose: discs of leaf where plants stand, bare soil elsewhere."""
        image = np.full((CAMERA.height_px, CAMERA.width_px, 3), SOIL_BGR, np.uint8)
        plane = canopy_plane(CAMERA, self.task.crop)
        looking = pose.heading_rad + (0.0 if name is CameraName.FRONT else pi)
        c, s = np.cos(looking), np.sin(looking)
        ground = (self.plants_m - [pose.x_m, pose.y_m]) @ np.array([[c, -s], [s, c]])
        pixels = plane.to_image(ground[(ground[:, 0] > NEAREST_M) & (ground[:, 0] < FURTHEST_M)])
        radii = plane.pixels_per_metre(pixels[:, 1]) * LEAF * self.task.crop.plants.canopy_width_m
        for (u, v), radius in zip(pixels.round().astype(int), radii.round().astype(int), strict=True):
            cv2.circle(image, (int(u), int(v)), max(1, int(radius)), LEAF_BGR, cv2.FILLED)
        return image

    def seen(self, cameras: tuple[CameraName, ...]) -> Observation:
        """The observation of this tick, with frames at every third one, taken the tick before."""
        names = cameras if self.ticks % FRAME_TICKS == 0 else ()
        frames = {
            name: Frame(name, self.ticks, self.now_s - TICK_S, self.picture(name, self.then))
            for name in names
        }
        exposed = dict.fromkeys(frames, self.then_reckoned)
        return Observation(self.now_s, frames, self.forward_m, 0.0, False, True, True, self.reckoned, exposed)

    def obey(self, twist: Twist) -> None:
        """Move for a tick as a state wants, pushed aside by what the wheels do not report."""
        self.then, self.then_reckoned = self.true, self.reckoned
        pushed = replace(twist, vy_mps=twist.vy_mps + self.sideslip * twist.vx_mps)
        self.true, self.reckoned = self.true.moved(pushed, TICK_S), self.reckoned.moved(twist, TICK_S)
        self.forward_m += twist.vx_mps * TICK_S
        self.now_s += TICK_S
        self.ticks += 1

    def drive(self, state: str, to_m: float = 60.0, watch: Callable[[Step], None] | None = None) -> Step:
        """Obey one state until it has an event or the robot has come to a place."""
        behaviour: Behaviour = STATES[state](self.task, self.direction, self.memory)
        while True:
            step = behaviour.step(self.seen(behaviour.cameras))
            assert self.now_s < LONGEST_S, f"{state} goes on at {self.s_m:.2f} m"
            if watch:
                watch(step)
            if step.evidence:
                self.passed.append((self.s_m, state, step))
            if step.event or self.s_m >= to_m:
                return step
            self.obey(step.motion.twist)

    def follow(
        self, state: str = "tracking", to_m: float = 60.0, watch: Callable[[Step], None] | None = None
    ) -> Step:
        """Go from state to state, until one ends the lane or the robot has come to a place."""
        while True:
            step = self.drive(state, to_m, watch)
            if step.event is None or step.event not in NEXT:
                return step
            state = NEXT[step.event]
            self.obey(step.motion.twist)

    def went_through(self) -> list[str]:
        """The states, each as often as it was entered."""
        names = [name for _, name, _ in self.passed]
        return [name for name, before in zip(names, [None, *names], strict=False) if name != before]


def lane(
    crop: CropProfile, ends_m: tuple[float, ...], gaps_m: tuple[tuple[float, float], ...] = ()
) -> Floats:
    """Plants of a lane along x, up to each row's end, shape (n, 2), with gaps of all rows."""
    random = np.random.default_rng(SEED)
    rows = [
        np.stack([along, np.full(len(along), y)], axis=-1)
        for y, end_m in zip(comb_m(crop), ends_m, strict=True)
        for along in [np.arange(end_m, -2.0, -crop.plants.spacing_m)]
    ]
    plants = np.concatenate(rows)
    for from_m, to_m in gaps_m:
        plants = plants[(plants[:, 0] <= from_m) | (plants[:, 0] >= to_m)]
    return plants + random.normal(0, [0.003, 0.012], plants.shape)


def robot(
    crop: CropProfile,
    plants_m: Floats,
    direction: Direction = Direction.FORWARD,
    expected_m: float | None = None,
    number: int = 1,
    left_m: float = 0.0,
    turned_deg: float = 0.0,
) -> Robot:
    """A robot that has just found its lane."""
    heading = radians(turned_deg) + (0.0 if direction is Direction.FORWARD else pi)
    task = Task(crop, dict.fromkeys(CameraName, CAMERA), Side.RIGHT, lanes=2)
    made = Robot(task, direction, plants_m, LaneMemory(number, expected_m), Pose(0.0, left_m, heading))
    step = made.drive("acquiring")
    assert step.event is Event.ROWS_FOUND, step
    made.passed.clear()
    return made


def profile(law: ControlLaw, name: str = "sugar-beet", **row_end: float) -> CropProfile:
    crop = load_crop(name)
    return crop.model_copy(
        update={
            "control": crop.control.model_copy(update={"law": law}),
            "row_end": crop.row_end.model_copy(update=row_end),
        }
    )


@pytest.fixture(scope="session")
def drawn() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    return SimpleNamespace(
        lane=lane, robot=robot, profile=profile, camera=CAMERA, states=STATES, frame_ticks=FRAME_TICKS
    )
