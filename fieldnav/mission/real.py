"""The composition root of a run on a robot: the same mission as in simulation, on the wall clock."""

import gc
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from datetime import datetime

import cv2

from drivers.can_log import LoggedBus
from drivers.thorvald import ThorvaldWheels
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.files import first_failure_told
from fieldnav.journal.journal import Journal
from fieldnav.journal.ledger import Booking, Ledger
from fieldnav.journal.refused import removed_if_refused
from fieldnav.journal.summary import Headland, Summary, write_summary
from fieldnav.messages import Side
from fieldnav.mission.driving import Driving
from fieldnav.mission.figures import Figures
from fieldnav.mission.interruption import Interruption
from fieldnav.mission.loop import Mission
from fieldnav.mission.operating import Operating
from fieldnav.mission.pace import Pace, RunClock
from fieldnav.mission.status_board import StatusBoard
from fieldnav.mission.tape import taping
from fieldnav.mission.taped_bus import TapedBus
from fieldnav.mission.taped_camera import taped_cameras
from fieldnav.mission.tick import Observer
from fieldnav.operator.confirmation import Confirmations
from fieldnav.operator.desk import Desk
from fieldnav.operator.request import Requests
from fieldnav.preflight.gear import Gear
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.robot import Robot
from states.behaviour import Task
from states.names import Event

PATIENCE_S = 0.0005
"""The loop waits no longer for a thread that has the interpreter: the recorder's, a camera's."""


@dataclass(frozen=True, slots=True)
class Order:
    """Everything that decides a run; `resumed` is where one that was broken off goes on.

    record: whether it is recorded; once: end at the first fault instead of waiting for a person.
    """

    crop: CropProfile
    robot: Robot
    lanes: int
    side: Side
    dry_run: bool = False
    once: bool = False
    confirm: frozenset[Event] = field(default_factory=frozenset)
    record: bool = False
    resumed: Booking | None = None


@dataclass(frozen=True, slots=True)
class Watchers:
    """Who watches a run and who may ask something of it, beside the desk that every run has."""

    observers: Sequence[Observer] = ()
    requests: Sequence[Requests] = ()


def drive(
    order: Order,
    gear: Gear,
    directory: RunDirectory,
    begun: datetime,
    clock: RunClock,
    watchers: Watchers,
) -> Summary:
    """Drive the mission to its end, with what has been opened and found well; begun: second 0, in UTC.

    Raises FieldnavError, KeyboardInterrupt after a stop by signal; the wheels then stand.
    """
    assert gear.bus, "the pre-flight refuses without a bus"
    cv2.setNumThreads(1)
    with removed_if_refused(directory), ExitStack() as stack:
        interruption = stack.enter_context(Interruption())
        ledger = stack.enter_context(Ledger(directory.ledger))
        desk = stack.enter_context(Desk.open(directory.path.name))
        tape = stack.enter_context(taping(directory, order.robot, begun, order.record, waits=False))
        journal = stack.enter_context(Journal(directory.journal, begun, tape.line))
        append = order.resumed is not None
        bus = LoggedBus(gear.bus, directory.can_log, order.robot.can.channel, append, clock)
        taped = TapedBus(bus, tape)
        stack.callback(taped.shutdown)
        wheels = ThorvaldWheels(order.robot, taped, listening=order.dry_run, clock=tape.clock(clock))
        figures = Figures(order.lanes, order.resumed.done if order.resumed else ())
        board = StatusBoard(directory.path.name, order.lanes)
        pinholes = order.robot.cameras.pinholes()
        mission = Mission(
            order.robot,
            Task(order.crop, pinholes, order.side, order.lanes),
            taped_cameras(tape, gear.cameras, order.robot),
            wheels,
            journal,
            [figures, board, tape, *watchers.observers],
            ledger,
            Confirmations(order.confirm),
            commanding=not order.dry_run,
        )
        operating = Operating(mission, tape)
        if order.resumed is not None:
            operating.take_up(order.resumed)
        pace = Pace(clock)
        requests = (desk, *watchers.requests)
        driving = Driving(mission, operating, board, bus, requests, pace, clock, gear.reopen_bus)
        stack.callback(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(PATIENCE_S)
        gc.collect()
        gc.freeze()  # what lives for ever need not be looked through again while the robot drives
        try:
            driving.run(interruption, order.once)
        finally:
            figures.warn(*tape.end())
            summary = figures.summary(clock(), Headland(), None, pace.health())
            with first_failure_told():
                write_summary(directory.summary, summary)
        return summary
