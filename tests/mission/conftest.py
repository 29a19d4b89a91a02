"""A mission on drawn pictures, with the real driver and simulated modules on a virtual bus."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from math import cos, radians, tan
from pathlib import Path

import can
import cv2
import numpy as np
import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import DriverError, OutputError
from fieldnav.journal.entry import Entry, Line
from fieldnav.journal.journal import Journal, read
from fieldnav.messages import CameraName, Frame, Image, Side
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.tick import Tick
from fieldnav.operator.confirmation import Confirmations
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop, load_robot
from states.behaviour import Step, Task
from states.names import Event

PINHOLE = Pinhole(640, 360, 320 / tan(radians(69) / 2), 1.0, radians(65), 0.75)
FRAME_S = 1 / 15
DRIVING_S = 2.0
"""Enough to check, to acquire, and to reach the working speed."""


def lane_picture(crop: CropProfile, way_m: float = 0.0) -> Image:
    """Three rows of leaf discs on bare soil, straight under the robot, after some way along them."""
    image = np.full((PINHOLE.height_px, PINHOLE.width_px, 3), (72, 96, 122), np.uint8)
    plane = canopy_plane(PINHOLE, crop)
    for row in (-1, 0, 1):
        for x in np.arange(0.5, 2.4, crop.plants.spacing_m) - way_m % crop.plants.spacing_m:
            u, v = plane.to_image(np.array([x, row * crop.rows.spacing_m]))
            if np.isfinite([u, v]).all():
                cv2.circle(image, (round(u), round(v)), 32, (50, 150, 70), cv2.FILLED)
    return image


@dataclass
class DrawnCamera:
    """A camera that sees a lane without end, until it is told to do otherwise; way_m: come so far along
    it."""

    name: CameraName
    crop: CropProfile
    image: Image | None = None
    way_m: float = 0.0
    frozen_at_s: float | None = None
    broken: bool = False

    def latest(self, now_s: float) -> Frame | None:
        if self.broken:
            raise DriverError(f"{self.name.value} camera: the source is gone")
        at_s = now_s if self.frozen_at_s is None else min(now_s, self.frozen_at_s)
        sequence = int(at_s / FRAME_S)
        if not sequence:
            return None
        if getattr(self, "_frame", None) is None or self._frame.sequence != sequence:
            self._frame = Frame(self.name, sequence, sequence * FRAME_S, self._noisy(sequence))
        return self._frame

    def _noisy(self, sequence: int) -> Image:
        """A sensor's noise never comes twice."""
        noisy = lane_picture(self.crop, self.way_m) if self.image is None else self.image.copy()
        few = noisy[::8, ::8]
        few += np.random.default_rng(sequence).integers(0, 3, few.shape).astype(np.uint8)
        return noisy

    def close(self) -> None:
        """Nothing to give back."""


class FullDisk(Journal):
    """A journal on a disk that is full from some entry on."""

    full = False

    def record(self, entry: Entry) -> None:
        if self.full:
            raise OutputError("journal.jsonl: cannot be written: No space left on device")
        super().record(entry)


class Rig:
    """A mission on drawn pictures, the real driver, and simulated modules on a virtual bus."""

    def __init__(
        self, folder: Path, host: can.BusABC, far: can.BusABC, confirmations: Confirmations | None = None
    ) -> None:
        robot, crop = load_robot("bonnbot"), load_crop("sugar-beet")
        self.far = far
        self.modules = SimulatedModules(robot, far)
        self.wheels = ThorvaldWheels(robot, host)
        self.cameras = {name: DrawnCamera(name, crop) for name in CameraName}
        self.journal = FullDisk(folder / "journal.jsonl", datetime(2000, 1, 1, tzinfo=UTC))
        self._path = folder / "journal.jsonl"
        task = Task(crop, dict.fromkeys(CameraName, PINHOLE), Side.RIGHT, lanes=1)
        self.watching: list[Tick] = []
        self.mission = Mission(
            robot, task, self.cameras, self.wheels, self.journal, [self], None, confirmations
        )
        self.now_s = 0.0
        self.fails_to_watch = False

    def watch(self, tick: Tick) -> None:
        if self.fails_to_watch:
            raise ValueError("cannot draw")
        self.watching.append(tick)

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK_S)):
            self._roll()
            self.mission.tick(self.now_s)

    def proposes(self, event: Event) -> None:
        """Let the present state propose an event in the next round."""
        self.mission.course.behaviours.current = Proposing(event)

    def coast(self, seconds: float) -> None:
        """Let the modules go on without the host."""
        for _ in range(round(seconds / TICK_S)):
            self._roll()

    def _roll(self) -> None:
        """Let the modules go on for a tick, and the cameras with them."""
        self.now_s += TICK_S
        self.modules.step(self.now_s)
        speeds = [state.speed_mps * cos(state.steering_rad) for state in self.modules.wheel_states().values()]
        for name, camera in self.cameras.items():
            looking = 1 if name is CameraName.FRONT else -1
            camera.way_m += looking * sum(speeds) / len(speeds) * TICK_S

    def fastest_mps(self) -> float:
        return max(abs(wheel.speed_mps) for wheel in self.modules.wheel_states().values())

    def lines(self) -> list[Line]:
        return read(self._path)


@dataclass
class Proposing:
    """A behaviour that has made up its mind."""

    event: Event
    cameras: tuple[CameraName, ...] = ()

    def step(self, seen: object) -> Step:
        return Step(event=self.event)


@pytest.fixture
def rig_with(tmp_path: Path) -> Iterator[Callable[[Confirmations | None], Rig]]:
    """Makes a rig, which drives already; with what a person must confirm."""
    made: list[Rig] = []
    buses: list[can.BusABC] = []

    def make(confirmations: Confirmations | None, pair: tuple[can.BusABC, can.BusABC] | None = None) -> Rig:
        host, far = pair or open_virtual_pair()
        buses.extend((host, far))
        made.append(Rig(tmp_path, host, far, confirmations))
        made[-1].mission.start(0.0)
        made[-1].run(DRIVING_S)
        assert made[-1].fastest_mps() > 0.3, "the rig drives before anything is broken"
        return made[-1]

    yield make
    for each in made:
        each.journal.close()
    for bus in buses:
        bus.shutdown()


@pytest.fixture
def rig(rig_with: Callable[[Confirmations | None], Rig]) -> Rig:
    return rig_with(None)
