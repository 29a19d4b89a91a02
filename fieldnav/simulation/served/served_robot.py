"""The composition root of a served robot: the world on the wall clock, its modules on a bus, its cameras."""

import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from types import TracebackType
from typing import Self

import can
import cv2

from drivers.simulated_modules import SimulatedModules
from drivers.wire_layout import check_nodes
from fieldnav.messages import CameraName, Side
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.fit import check_fit, check_size
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import Renderer, SimulatedCamera
from fieldnav.simulation.plan import FieldPlan, sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.served.can_hub import CanHub
from fieldnav.simulation.served.hub_bus import HubBus
from fieldnav.simulation.served.picture_feed import PictureFeed
from fieldnav.simulation.served.picture_server import PictureServer
from fieldnav.simulation.served.robot_file import reached_at
from fieldnav.simulation.served.witness import Account, Witness
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import STEP_S, World, module_errors

CHANNEL = "can0"
ANY_PORT = 0
CATCH_UP_STEPS = 20
"""Steps of the world at most between two looks at the bus, however late it is: 0.1 s."""
TOLERANCE_STEPS = 1e-6
"""Far above the rounding of a time in seconds over the step."""


@dataclass(frozen=True, slots=True)
class Offer:
    """Everything that decides a served robot; with a port the bus is there and the pictures at the next."""

    field: FieldSettings
    crop: CropProfile
    robot: Robot
    side: Side
    port: int = ANY_PORT
    sketch: bool = False


class ServedRobot:
    """Its bus and cameras are there from the beginning; it moves while `serve` runs.

    `now_s` is the time that the world goes by: the clock's, from the moment everything was there.
    Raises FieldnavError for settings that do not fit and for ports that are not to be had.
    """

    def __init__(self, offer: Offer, monotonic_s: Callable[[], float] = time.monotonic) -> None:
        field, robot = offer.field, offer.robot
        check_fit(offer.crop, robot, field.lane_pitch_m)
        check_nodes(robot)
        check_size(field, offer.crop)
        cv2.setNumThreads(1)
        self._field = field
        plan = sow(field, offer.crop, offer.side)
        renderers = {name: _renderer(offer, plan) for name in CameraName}
        started_s = monotonic_s()
        self.now_s: Callable[[], float] = lambda: monotonic_s() - started_s
        with ExitStack() as stack:
            self.hub = CanHub(offer.port, CHANNEL, self.now_s, time.time())
            stack.callback(self.hub.close)
            bus: can.BusABC = HubBus(self.hub)
            stack.callback(bus.shutdown)
            errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
            modules = SimulatedModules(robot, bus, errors, field.wheel_errors.can_delay_s)
            self.world = World(plan, field, robot, modules)
            self._witness = Witness(self.world)
            self.feeds = {name: self._feed(name, renderers[name], stack) for name in CameraName}
            self.pictures = PictureServer(offer.port + 1 if offer.port else ANY_PORT, self.feeds)
            stack.callback(self.pictures.close)
            self._open = stack.pop_all()
        sources = {name: self.pictures.source(name) for name in CameraName}
        latency_s = field.camera_errors.latency_s
        self.robot = reached_at(robot, CHANNEL, self.hub.address, sources, latency_s)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._open.close()

    def serve(self, stopping: Callable[[], bool]) -> None:
        """Let the world go on with the clock; when it was late it catches up, a few steps at a time."""
        step = round(self.world.now.stamp_s / STEP_S)
        while not stopping():
            self.hub.attend((step + 1) * STEP_S)
            reached = int(self.now_s() / STEP_S + TOLERANCE_STEPS)
            for _ in range(min(reached - step, CATCH_UP_STEPS)):
                step += 1
                self.world.advance(step * STEP_S)
                self._witness.note()

    def account(self) -> Account:
        """What the robot has truly done so far."""
        return self._witness.account(self._field.lanes)

    def _feed(self, name: CameraName, renderer: Renderer, stack: ExitStack) -> PictureFeed:
        camera = SimulatedCamera(name, self.world, renderer)
        feed = PictureFeed(name, camera, self._field.camera_errors.latency_s, self.now_s)
        stack.callback(feed.close)
        return feed


def _renderer(offer: Offer, plan: FieldPlan) -> Renderer:
    """One a camera: what a renderer keeps of the ground is not for two threads to change."""
    kind = SketchRenderer if offer.sketch else FieldRenderer
    return kind(plan, offer.field, offer.crop)
