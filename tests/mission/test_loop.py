"""What the loop does when something breaks: the wheels stop first, and the journal says why."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import partial
from math import radians, tan
from pathlib import Path

import can
import cv2
import numpy as np
import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.simulated_motion import SimulatedMotion
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import DriverError, FieldnavError, OutputError
from fieldnav.journal.entry import Entry, Line
from fieldnav.journal.journal import Journal, read
from fieldnav.messages import CameraName, Frame, Image, Side
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.tick import Tick
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop, load_robot
from states.behaviour import Task
from states.names import Event
from states.table import LATCHED, RECOVERABLE

PINHOLE = Pinhole(640, 360, 320 / tan(radians(69) / 2), 1.0, radians(65), 0.75)
FRAME_S = 1 / 15
DRIVING_S = 2.0
"""Enough to check, to acquire, and to reach the working speed."""


def lane_picture(crop: CropProfile) -> Image:
    """Three rows of leaf discs on bare soil, straight under the robot."""
    image = np.full((PINHOLE.height_px, PINHOLE.width_px, 3), (72, 96, 122), np.uint8)
    plane = canopy_plane(PINHOLE, crop)
    for row in (-1, 0, 1):
        for x in np.arange(0.5, 2.2, crop.plants.spacing_m):
            u, v = plane.to_image(np.array([x, row * crop.rows.spacing_m]))
            if np.isfinite([u, v]).all():
                cv2.circle(image, (round(u), round(v)), 32, (50, 150, 70), cv2.FILLED)
    return image


@dataclass
class DrawnCamera:
    """A camera that sees the same lane for ever, until it is told to do otherwise."""

    name: CameraName
    image: Image
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
        noisy = self.image.copy()
        noisy[::2, ::2] += np.uint8(sequence % 2)
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

    def __init__(self, folder: Path, host: can.BusABC, far: can.BusABC) -> None:
        robot, crop = load_robot("bonnbot"), load_crop("sugar-beet")
        self.modules = SimulatedModules(robot, far)
        self.wheels = ThorvaldWheels(robot, host)
        self.cameras = {name: DrawnCamera(name, lane_picture(crop)) for name in CameraName}
        self.journal = FullDisk(folder / "journal.jsonl", datetime(2000, 1, 1, tzinfo=UTC))
        self._path = folder / "journal.jsonl"
        task = Task(crop, dict.fromkeys(CameraName, PINHOLE), Side.RIGHT, lanes=1)
        self.watching: list[Tick] = []
        self.mission = Mission(robot, task, self.cameras, self.wheels, self.journal, [self])
        self.now_s = 0.0
        self.fails_to_watch = False

    def watch(self, tick: Tick) -> None:
        if self.fails_to_watch:
            raise ValueError("cannot draw")
        self.watching.append(tick)

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK_S)):
            self.now_s += TICK_S
            self.modules.step(self.now_s)
            self.mission.tick(self.now_s)

    def coast(self, seconds: float) -> None:
        """Let the modules go on without the host."""
        for _ in range(round(seconds / TICK_S)):
            self.now_s += TICK_S
            self.modules.step(self.now_s)

    def fastest_mps(self) -> float:
        return max(abs(wheel.speed_mps) for wheel in self.modules.wheel_states().values())

    def lines(self) -> list[Line]:
        return read(self._path)


@pytest.fixture
def rig(tmp_path: Path) -> Iterator[Rig]:
    host, far = open_virtual_pair()
    made = Rig(tmp_path, host, far)
    made.mission.start(0.0)
    made.run(DRIVING_S)
    assert made.fastest_mps() > 0.3, "the rig drives before anything is broken"
    yield made
    made.journal.close()
    host.shutdown()
    far.shutdown()


def test_a_camera_that_is_gone_stops_the_wheels_and_latches(rig: Rig) -> None:
    rig.cameras[CameraName.FRONT].broken = True
    rig.run(1.0)
    assert rig.mission.machine.leaf == LATCHED
    assert rig.fastest_mps() == 0
    assert "the source is gone" in rig.lines()[-1].reason


def test_a_frozen_camera_stops_the_wheels_and_says_how_old_its_frame_is(rig: Rig) -> None:
    rig.cameras[CameraName.FRONT].frozen_at_s = rig.now_s
    rig.run(1.5)
    assert rig.fastest_mps() == 0
    assert any("s old" in line.reason for line in rig.lines())
    rig.run(2.0)
    assert rig.mission.machine.leaf == RECOVERABLE
    assert "the wheels were held for 2.0 s" in rig.lines()[-1].reason


def test_an_error_in_the_program_stops_the_wheels_before_it_is_told(rig: Rig) -> None:
    rig.cameras[CameraName.FRONT].image = np.zeros((2, 2), np.uint8)  # no colour image at all
    rig.mission.behaviours.current = _Raising()
    with pytest.raises(FieldnavError, match="broke off: ZeroDivisionError"):
        rig.run(0.1)
    rig.coast(1.0)
    assert rig.fastest_mps() == 0
    assert rig.mission.machine.leaf == LATCHED
    assert "ZeroDivisionError" in rig.lines()[-1].reason


def test_a_full_disk_stops_the_wheels(rig: Rig) -> None:
    rig.journal.full = True
    rig.cameras[CameraName.FRONT].frozen_at_s = rig.now_s
    with pytest.raises(OutputError, match="No space left"):
        rig.run(2.0)
    rig.coast(1.0)
    assert rig.fastest_mps() == 0


def test_an_observer_that_fails_is_dropped_and_the_mission_goes_on(rig: Rig) -> None:
    rig.fails_to_watch = True
    rig.run(0.5)
    assert rig.fastest_mps() > 0.3
    assert "cannot draw" in rig.lines()[-1].reason


def test_a_silent_module_ends_the_mission_only_after_time_to_stop(rig: Rig) -> None:
    next(iter(rig.modules.modules.values())).silent = True
    while not rig.mission.over:
        rig.run(TICK_S)
    assert rig.mission.machine.leaf == LATCHED
    others = list(rig.modules.wheel_states().values())[1:]
    assert max(abs(wheel.speed_mps) for wheel in others) == 0


def test_stuck_wheels_are_a_fault_that_says_so(rig: Rig) -> None:
    _hold_still(rig)
    rig.run(4.5)
    assert rig.mission.machine.leaf == RECOVERABLE, rig.lines()[-1].reason
    assert "stand still" in rig.lines()[-1].reason


def test_an_interruption_by_the_operator_is_in_the_journal(rig: Rig) -> None:
    rig.mission.break_off(rig.now_s, Event.FAIL, "interrupted by the operator")
    rig.run(1.0)
    assert rig.fastest_mps() == 0
    assert rig.lines()[-1].reason == "interrupted by the operator"


class _Raising:
    """A behaviour with a mistake in it."""

    cameras: tuple[CameraName, ...] = ()

    def step(self, seen: object) -> Callable[[], None]:
        raise ZeroDivisionError("a mistake")


def _hold_still(rig: Rig) -> None:
    """Modules that are told to drive and do not: a wheel each against a stone."""
    for module in rig.modules.modules.values():
        motion = module.motion
        motion.advance = partial(stand_still, motion)  # type: ignore[method-assign] # the fault itself


def stand_still(motion: SimulatedMotion, *_: object) -> None:
    motion.speed_mps = 0.0
