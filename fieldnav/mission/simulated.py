"""The composition root of a simulated run: the same mission as on a robot, on a simulated field and bus."""

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import cv2

from drivers.can_log import LoggedBus, open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import FieldnavError
from fieldnav.evaluation.path import PathObserver
from fieldnav.evaluation.truth import headland, judge
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import Journal
from fieldnav.journal.resolved import write_settings
from fieldnav.journal.summary import Summary, write_summary
from fieldnav.messages import CameraName, Side
from fieldnav.mission.figures import Figures
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.pictures import OverlayObserver, draw_run
from fieldnav.mission.tick import Observer
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.fit import check_fit
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Task

EPOCH = datetime(2000, 1, 1, tzinfo=UTC)
"""Where simulated time begins, so that a journal depends on the seed alone."""
SLOWEST_MPS = 0.1
SWITCH_S = 120.0
"""A mission that takes longer than its length at this speed and this for each switch is stuck."""


@dataclass(frozen=True, slots=True)
class Run:
    """Everything that decides a simulated run."""

    field: FieldSettings
    crop: CropProfile
    robot: Robot
    lanes: int
    side: Side
    parent: Path
    video: bool = False
    realtime: bool = False


def simulate(run: Run, observers: Sequence[Observer] = ()) -> tuple[RunDirectory, Summary]:
    """Drive the mission to its end; returns the run directory and the figures.

    Raises FieldnavError for settings that do not fit, an unwritable folder, or a mission that does not end.
    """
    check_fit(run.crop, run.robot, run.field.lane_pitch_m)
    cv2.setNumThreads(1)
    plan = sow(run.field, run.crop, run.side)
    directory = RunDirectory.create(run.parent, run.field.name, datetime.now(UTC))
    options = {"lanes": run.lanes, "side": run.side.value, "video": run.video, "realtime": run.realtime}
    write_settings(directory.settings, run.crop, run.robot, run.field, options)
    with ExitStack() as stack:
        host, far_end = open_virtual_pair()
        stack.callback(far_end.shutdown)
        bus = LoggedBus(host, directory.can_log, run.robot.can.channel)
        stack.callback(bus.shutdown)
        field = run.field
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(run.robot, far_end, errors, field.wheel_errors.can_delay_s)
        world = World(plan, field, run.robot, modules)
        renderer = FieldRenderer(plan, field, run.crop)
        cameras = {name: SimulatedCamera(name, world, renderer) for name in CameraName}
        wheels = ThorvaldWheels(run.robot, bus)
        journal = stack.enter_context(Journal(directory.journal, EPOCH))
        figures, path = Figures(run.lanes), PathObserver(world)
        watching: list[Observer] = [figures, path, *observers]
        if run.video:
            watching.append(stack.enter_context(OverlayObserver(directory.overlay, run.robot, run.lanes)))
        pinholes = {name: run.robot.cameras.get(name).pinhole() for name in CameraName}
        task = Task(run.crop, pinholes, run.side, run.lanes)
        mission = Mission(run.robot, task, cameras, wheels, journal, watching)
        started = time.perf_counter()
        try:
            _drive(mission, world.advance, run, started)
        finally:
            wheels.stop(world.now.stamp_s)
            wall_s = time.perf_counter() - started
            truth = judge(world, path, run.lanes)
            summary = figures.summary(wall_s, headland(world, path), truth)
            write_summary(directory.summary, summary)
        draw_run(directory.map, plan, path, run.field.name, summary)
    return directory, summary


def _drive(mission: Mission, advance: Callable[[float], None], run: Run, started: float) -> None:
    """Tick until the mission is over; in real time no faster than the clock."""
    limit_s = run.lanes * (run.field.length_m / SLOWEST_MPS + SWITCH_S)
    mission.start(0.0)
    ticks = 0
    while not mission.over:
        ticks += 1
        now_s = ticks * TICK_S
        if now_s > limit_s:
            raise FieldnavError(f"the mission has not ended within {limit_s:.0f} s of the robot's time")
        advance(now_s)
        mission.tick(now_s)
        if run.realtime:
            time.sleep(max(0.0, now_s - (time.perf_counter() - started)))
