"""A drawn field and what a behaviour is told of it, without a robot, a clock or a bus."""

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import radians, tan
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.messages import Bound, CameraName, Direction, Evidence, Frame, Image, Side
from fieldnav.odometry import Pose
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop
from states.behaviour import Behaviour, Observation, Step, Task
from states.names import Event

SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
LEAF = 0.4
"""Radius of a drawn plant over the canopy's width."""
TICK_S = 1 / 15

CAMERA = Pinhole(320, 180, 160 / tan(radians(69) / 2), 1.0, radians(65), 0.75)


def rows(crop: CropProfile, from_m: float = 0.4, to_m: float = 2.6, offset_m: float = 0.0) -> np.ndarray:
    """Where the plants of a lane stand, shape (n, 2), in a camera's ground coordinates."""
    along = np.arange(from_m, to_m, crop.plants.spacing_m)
    count = crop.rows.per_lane
    places = [offset_m + ((count - 1) / 2 - row) * crop.rows.spacing_m for row in range(count)]
    return np.array([[x, y] for y in places for x in along]).reshape(-1, 2)


def picture(crop: CropProfile, plants_m: np.ndarray, camera: Pinhole = CAMERA) -> Image:
    """Discs of leaf where the plants stand, bare soil elsewhere."""
    image = np.full((camera.height_px, camera.width_px, 3), SOIL_BGR, np.uint8)
    plane = canopy_plane(camera, crop)
    for u, v in plane.to_image(plants_m.reshape(-1, 2)):
        if np.isfinite([u, v]).all() and abs(u) < 2 * camera.width_px and abs(v) < 2 * camera.height_px:
            radius = float(plane.pixels_per_metre(v)) * LEAF * crop.plants.canopy_width_m
            cv2.circle(image, (round(u), round(v)), max(1, round(radius)), LEAF_BGR, cv2.FILLED)
    return image


@dataclass
class Situation:
    """Where the robot is and what it sees; `seen` is the observation of the next tick."""

    now_s: float = 0.0
    forward_m: float = 0.0
    sideways_m: float = 0.0
    stopped: bool = True
    aligned: bool = True
    ready: bool = True
    sequence: int = 0
    pose: Pose = field(default_factory=Pose)

    def seen(self, images: Mapping[CameraName, Image] | None = None, dt_s: float = TICK_S) -> Observation:
        self.now_s += dt_s
        self.sequence += 1
        frames = {
            name: Frame(name, self.sequence, self.now_s, image) for name, image in (images or {}).items()
        }
        return Observation(
            now_s=self.now_s,
            frames=frames,
            forward_m=self.forward_m,
            sideways_m=self.sideways_m,
            stopped=self.stopped,
            wheels_aligned=self.aligned,
            wheels_ready=self.ready,
            pose=self.pose,
            exposed=dict.fromkeys(CameraName, self.pose),
        )


PITCH_M = 1.5
ROWS_FROM_M, ROWS_TO_M = 1.1, 2.4
"""Where the rows begin and end behind the robot, from its centre."""


def lanes(
    task: Task,
    direction: Direction,
    numbers: tuple[int, ...] = (0, 1, 2),
    without: tuple[tuple[int, int], ...] = (),
    nearer_m: float = 0.0,
) -> np.ndarray:
    """Where the plants of whole lanes stand on the ground, shape (n, 2); lane 0 is that of the robot.

    without: (lane, row from the inside) not sown; nearer_m: by how much lane 1 reaches nearer to the robot.
    """
    crop, behind = task.crop, -direction.sign
    plants = []
    for lane in numbers:
        for row in range(crop.rows.per_lane):
            if (lane, row) in without:
                continue
            place = lane * PITCH_M + (row - (crop.rows.per_lane - 1) / 2) * crop.rows.spacing_m
            first_m = ROWS_FROM_M - (nearer_m if lane == 1 else 0.0)
            x = np.arange(first_m, ROWS_TO_M, crop.plants.spacing_m)
            plants.append(np.stack([behind * x, np.full(len(x), task.side.sign * place)], axis=-1))
    return np.concatenate(plants)


@dataclass
class Stepping:
    """A robot at the end of a lane that obeys behaviours and sees the plants behind it."""

    task: Task
    direction: Direction
    plants_m: np.ndarray
    situation: Situation = field(default_factory=Situation)

    @property
    def way_m(self) -> float:
        """How far it has come to the next lane's side."""
        return self.task.side.sign * self.situation.pose.y_m

    def look(self, plants_m: np.ndarray | None = None) -> Image:
        """What the trailing camera shows here."""
        pose = self.situation.pose
        c, s = np.cos(pose.heading_rad), np.sin(pose.heading_rad)
        away = (self.plants_m if plants_m is None else plants_m) - [pose.x_m, pose.y_m]
        return picture(self.task.crop, -self.direction.sign * away @ np.array([[c, -s], [s, c]]))

    def obey(self, behaviour: Behaviour, frames: int, plants_m: np.ndarray | None = None) -> Step:
        """Let the behaviour lead until it has an event or so many frames are over; returns its last step."""
        for _ in range(frames):
            step = behaviour.step(self.situation.seen({self.direction.trailing: self.look(plants_m)}))
            assert_explained(step)
            if step.event:
                break
            twist = step.motion.twist
            here = self.situation
            here.pose = here.pose if step.motion.hold else here.pose.moved(twist, TICK_S)
            here.forward_m, here.sideways_m = here.pose.x_m, here.pose.y_m
            here.stopped = step.motion.hold or not (twist.vx_mps or twist.vy_mps)
        return step


COMPARED = {
    Bound.AT_LEAST: operator.ge,
    Bound.ABOVE: operator.gt,
    Bound.AT_MOST: operator.le,
    Bound.BELOW: operator.lt,
}


def _holds(judged: Evidence) -> bool:
    return judged.threshold is not None and COMPARED[judged.bound](judged.value, judged.threshold)


def _comes_about(step: Step, event: object) -> bool:
    """One of its conditions that are enough alone holds, or all of the others, of which there is one."""
    alone = [_holds(each) for each in step.evidence if each.fires is event and each.alone]
    together = [_holds(each) for each in step.evidence if each.fires is event and not each.alone]
    return any(alone) or (bool(together) and all(together))


def assert_explained(step: Step) -> None:
    """What was judged says why the event came about, and of every other why it did not."""
    told = f"{step.event}, {step.reason!r}: {step.evidence}"
    names = [judged.name for judged in step.evidence]
    assert len(names) == len(set(names)), f"two quantities of one name: {told}"
    if step.event is not None:
        assert _comes_about(step, step.event), f"the conditions do not hold: {told}"
        return
    for event in {judged.fires for judged in step.evidence} - {None}:
        assert isinstance(event, Event)
        assert not _comes_about(step, event), f"{event} should have come about: {told}"


@pytest.fixture(scope="session")
def explained() -> Callable[[Step], None]:
    """Asserts of a behaviour's step that its evidence explains it."""
    return assert_explained


@pytest.fixture(scope="session")
def drawn() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    crop = load_crop("sugar-beet")
    # Who knows nothing of the drill: tests of what that knowledge is worth put it back.
    crop = crop.model_copy(update={"rows": crop.rows.model_copy(update={"lane_pitch_m": None})})
    task = Task(crop, dict.fromkeys(CameraName, CAMERA), Side.RIGHT, lanes=2)
    return SimpleNamespace(
        crop=crop,
        task=task,
        camera=CAMERA,
        rows=rows,
        picture=picture,
        situation=Situation,
        lanes=lanes,
        stepping=Stepping,
        pitch_m=PITCH_M,
    )
