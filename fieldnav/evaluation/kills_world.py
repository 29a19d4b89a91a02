"""The world's process: a sketched field, its robot and its true path, whoever drives or nobody."""

from dataclasses import replace
from multiprocessing.connection import Connection

import cv2
import numpy as np

from drivers.simulated_modules import SimulatedModules
from fieldnav.evaluation.kills_line import Advance, Ended, Look, QueuedBus
from fieldnav.evaluation.path import PathObserver
from fieldnav.messages import CameraName, Side
from fieldnav.mission.loop import NOTHING_SENT, TICK_S
from fieldnav.mission.tick import Tick
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Step
from states.table import IDLE

NOBODY = Advance(0.0, (), IDLE, 1, 0)


class ServedWorld:
    """Does what a mission's process asks over its line; nobody asking, the robot is left to itself.

    told: where the mission last said that it stood.
    """

    def __init__(self, field: FieldSettings, crop: CropProfile, robot: Robot, side: Side) -> None:
        cv2.setNumThreads(1)
        plan = sow(field, crop, side)
        self._bus = QueuedBus()
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(robot, self._bus, errors, field.wheel_errors.can_delay_s)
        self.world = World(plan, field, robot, modules)
        renderer = SketchRenderer(plan, field, crop)
        self._cameras = {name: SimulatedCamera(name, self.world, renderer) for name in CameraName}
        self._shown: dict[CameraName, int] = {}
        self.path = PathObserver(self.world)
        self.told = NOBODY

    @property
    def now_s(self) -> float:
        return self.world.now.stamp_s

    @property
    def rim_mps(self) -> float:
        """The fastest wheel's speed."""
        return max(abs(wheel.speed_mps) for wheel in self.world.wheels().values())

    def begin(self, line: Connection) -> None:
        """Tell a new mission's process the time; it has not said where it is, nor seen any picture yet."""
        self.told = replace(self.told, state=IDLE)
        self._shown.clear()
        self._bus.taken()
        line.send(self.now_s)

    def answer(self, line: Connection) -> Ended | None:
        """Do the next thing asked; returns it if it is the end.

        Raises EOFError or OSError once nobody asks any more.
        """
        asked = line.recv()
        match asked:
            case Look():
                self._show(asked, line)
            case Advance():
                self.told = asked
                self._bus.arrive(asked.frames)
                self._advance(asked.until_s)
                line.send(self._bus.taken())
            case Ended():
                return asked
        return None

    def leave_alone(self, seconds: float) -> tuple[float, float]:
        """Let time pass without a mission.

        Returns when the last wheel that turned came to stand, in s from now, and the fastest one's speed.
        """
        begun_s, turning = self.now_s, [(0.0, self.rim_mps)]

        def note() -> None:
            if self.rim_mps > 0:
                turning.append((self.now_s - begun_s, self.rim_mps))

        self.world.after_step.append(note)
        for tick in range(1, round(seconds / TICK_S) + 1):
            self._advance(begun_s + tick * TICK_S)
        self.world.after_step.remove(note)
        return turning[-1][0], max(speed for _, speed in turning)

    def close(self) -> None:
        self._bus.shutdown()

    def _advance(self, until_s: float) -> None:
        self.world.advance(until_s)
        told = self.told
        self.path.watch(
            Tick(self.now_s, told.state, None, Step(), NOTHING_SENT, told.lane, 0, told.rows_passed, 0.0, 0.0)
        )

    def _show(self, asked: Look, line: Connection) -> None:
        frame = self._cameras[asked.camera].latest(asked.now_s)
        if frame is None or self._shown.get(asked.camera) == frame.sequence:
            line.send(None)
            return
        self._shown[asked.camera] = frame.sequence
        line.send((frame.sequence, frame.stamp_s, frame.image.shape))
        line.send_bytes(np.ascontiguousarray(frame.image).reshape(-1).data)
