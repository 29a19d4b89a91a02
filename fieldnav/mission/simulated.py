"""The composition root of a simulated run: the same mission as on a robot, on a simulated field and bus."""

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import cv2

from drivers.can_log import LoggedBus, open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from drivers.wire_layout import check_nodes
from fieldnav.errors import DriverError
from fieldnav.evaluation.path import PathObserver
from fieldnav.evaluation.truth import headland, judge
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.files import first_failure_told
from fieldnav.journal.journal import Journal
from fieldnav.journal.ledger import Ledger
from fieldnav.journal.refused import removed_if_refused
from fieldnav.journal.resolved import DRIVEN_UTC, write_settings
from fieldnav.journal.summary import Summary, write_summary
from fieldnav.messages import CameraName, Side
from fieldnav.mission.figures import Figures
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.operating import Operating
from fieldnav.mission.pictures import OverlayObserver, draw_run
from fieldnav.mission.tape import taping
from fieldnav.mission.taped_bus import TapedBus
from fieldnav.mission.taped_camera import taped_cameras
from fieldnav.mission.tick import Observer
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.fit import check_fit, check_size
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Task
from states.names import Event

EPOCH = datetime(2000, 1, 1, tzinfo=UTC)
"""Where simulated time begins, so that a journal depends on the seed alone."""
REST_S = 1.0
"""Longer than the ramp from top speed and the modules' watchdog."""
SLOWEST = 0.2
SWITCH_S = 120.0
"""A mission that takes longer than at this share of its speed, and this for each switch, is stuck."""


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
    sketch: bool = False
    record: bool = False


@dataclass(frozen=True, slots=True)
class Simulated:
    """A run that has ended: its directory, its figures, and the true path beside its field."""

    directory: RunDirectory
    summary: Summary
    driven: PathObserver


def simulate(
    run: Run, observers: Sequence[Observer] = (), stopping: Callable[[], bool] = lambda: False
) -> Simulated:
    """Drive the mission to its end, or until `stopping` says so, which is asked between two rounds.

    Raises FieldnavError for settings that do not fit, an unwritable folder, or a mission that does not end;
    KeyboardInterrupt where it was stopped, with everything written down.
    """
    check_fit(run.crop, run.robot, run.field.lane_pitch_m)
    check_nodes(run.robot)
    check_size(run.field, run.crop)
    cv2.setNumThreads(1)
    plan = sow(run.field, run.crop, run.side)
    driven = datetime.now(UTC)
    directory = RunDirectory.create(run.parent, run.field.name, driven)
    options = {"lanes": run.lanes, "side": run.side.value, "video": run.video, "realtime": run.realtime}
    options |= {DRIVEN_UTC: driven.isoformat(timespec="seconds")}
    with removed_if_refused(directory), ExitStack() as stack:
        write_settings(directory.settings, run.crop, run.robot, run.field, options)
        host, far_end = open_virtual_pair()
        stack.callback(far_end.shutdown)
        tape = stack.enter_context(taping(directory, run.robot, EPOCH, run.record, waits=True))
        bus = LoggedBus(host, directory.can_log, run.robot.can.channel)
        taped = TapedBus(bus, tape)
        stack.callback(taped.shutdown)
        field = run.field
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(run.robot, far_end, errors, field.wheel_errors.can_delay_s)
        world = World(plan, field, run.robot, modules)
        renderer = (SketchRenderer if run.sketch else FieldRenderer)(plan, field, run.crop)
        eyes = {name: SimulatedCamera(name, world, renderer) for name in CameraName}
        cameras = taped_cameras(tape, eyes, run.robot)
        wheels = ThorvaldWheels(run.robot, taped)
        journal = stack.enter_context(Journal(directory.journal, EPOCH, tape.line))
        figures, path = Figures(run.lanes), PathObserver(world)
        watching: list[Observer] = [figures, path, tape, *observers]
        if run.video:
            watching.append(stack.enter_context(OverlayObserver(directory.overlay, run.robot, run.lanes)))
        pinholes = run.robot.cameras.pinholes()
        task = Task(run.crop, pinholes, run.side, run.lanes)
        ledger = stack.enter_context(Ledger(directory.ledger))
        mission = Mission(run.robot, task, cameras, wheels, journal, watching, ledger)
        started = time.perf_counter()
        try:
            _drive(mission, Operating(mission, tape), bus, world, run, started, stopping)
        finally:
            _come_to_rest(wheels, world)
            wall_s = time.perf_counter() - started
            figures.warn(*tape.end())
            summary = figures.summary(wall_s, headland(world, path), judge(world, path, run.lanes))
            with first_failure_told():
                write_summary(directory.summary, summary)
                draw_run(directory.map, plan, path, run.field.name, summary)
    return Simulated(directory, summary, path)


def _come_to_rest(wheels: ThorvaldWheels, world: World) -> None:
    """Command zero until the modules have had time to stop, so that can.log shows it however a run ended."""
    until_s = world.now.stamp_s + REST_S
    while world.now.stamp_s < until_s:
        wheels.stop(world.now.stamp_s)
        world.advance(world.now.stamp_s + TICK_S)
        with suppress(DriverError):
            wheels.poll(world.now.stamp_s)


def _drive(
    mission: Mission,
    operating: Operating,
    bus: LoggedBus,
    world: World,
    run: Run,
    started: float,
    stopping: Callable[[], bool],
) -> None:
    """Tick until the mission is over; in real time no faster than the clock. Raises KeyboardInterrupt."""
    limit_s = run.lanes * (run.field.length_m / (SLOWEST * run.crop.speeds.follow_mps) + SWITCH_S)
    operating.start(0.0)
    ticks = 0
    while not mission.over:
        ticks += 1
        now_s = ticks * TICK_S
        try:
            world.advance(now_s)
            if stopping():
                raise KeyboardInterrupt
            operating.tick(now_s)
        except KeyboardInterrupt:
            operating.break_off(now_s, Event.FAIL, "interrupted by the operator")
            raise
        if bus.failure is not None:
            operating.break_off(now_s, Event.LATCH, bus.failure)
        if now_s > limit_s:
            operating.break_off(now_s, Event.FAIL, f"not ended within {limit_s:.0f} s of the robot's time")
        if run.realtime:
            time.sleep(max(0.0, now_s - (time.perf_counter() - started)))
