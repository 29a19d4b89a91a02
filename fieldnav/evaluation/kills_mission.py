"""The process that is killed: the mission of a robot, begun or taken up again in its run's directory."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from multiprocessing.connection import Connection
from pathlib import Path

import cv2

from drivers.ports import Camera, Wheels
from drivers.thorvald import ThorvaldWheels
from fieldnav.evaluation.kills_line import Advance, Ended, LineCamera, QueuedBus
from fieldnav.journal.journal import Journal
from fieldnav.journal.ledger import Ledger, last_booking
from fieldnav.messages import CameraName, Side
from fieldnav.mission.bookkeeping import place_of
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.robot import Robot
from states.behaviour import Task
from states.names import Path as StatePath
from states.table import FINISHED

EPOCH = datetime(2000, 1, 1, tzinfo=UTC)
"""Where simulated time begins."""


@dataclass(frozen=True, slots=True)
class MissionSetup:
    """What a mission's process is told: its run's directory and what is to be driven."""

    folder: Path
    robot: Robot
    crop: CropProfile
    side: Side
    lanes: int

    @property
    def journal(self) -> Path:
        return self.folder / "journal.jsonl"

    @property
    def ledger(self) -> Path:
        return self.folder / "ledger.jsonl"


def run_mission(setup: MissionSetup, line: Connection) -> None:
    """Drive to the end and say so; taken up again where the ledger says, once what is seen fits it.

    The world begins by telling its time. Raises FieldnavError.
    """
    cv2.setNumThreads(1)
    now_s = line.recv()
    booking = last_booking(setup.ledger)
    if booking is not None and booking.finished:
        line.send(Ended(FINISHED))
        return
    bus = QueuedBus()
    with Ledger(setup.ledger) as ledger, Journal(setup.journal, EPOCH) as journal:
        cameras = {name: LineCamera(name, line) for name in CameraName}
        mission = _mission(setup, cameras, ThorvaldWheels(setup.robot, bus), journal, ledger)
        if booking is not None:
            mission.course.resume_from(place_of(booking))
        line.send(Ended(_drive(mission, bus, line, now_s)))
    bus.shutdown()


def _mission(
    setup: MissionSetup,
    cameras: Mapping[CameraName, Camera],
    wheels: Wheels,
    journal: Journal,
    ledger: Ledger,
) -> Mission:
    pinholes = setup.robot.cameras.pinholes()
    task = Task(setup.crop, pinholes, setup.side, setup.lanes)
    return Mission(setup.robot, task, cameras, wheels, journal, ledger=ledger)


def _drive(mission: Mission, bus: QueuedBus, line: Connection, begun_s: float) -> StatePath:
    mission.start(begun_s)
    ticks = 0
    while not mission.over:
        ticks += 1
        now_s = begun_s + ticks * TICK_S
        lane = mission.course.behaviours.lane
        line.send(Advance(now_s, bus.taken(), mission.course.machine.leaf, lane.number, lane.rows_passed))
        bus.arrive(line.recv())
        mission.tick(now_s)
    return mission.course.machine.leaf
