"""The composition root of a foreign replay: the real mission with recorded pictures and assumed wheels."""

import re
import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import cv2

from drivers.ports import Camera
from fieldnav.errors import SettingsError
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import Journal
from fieldnav.journal.resolved import write_settings
from fieldnav.journal.summary import Headland, Summary, write_summary
from fieldnav.messages import CameraName
from fieldnav.mission.figures import Figures
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.operating import Operating
from fieldnav.mission.tape import Tape, taping
from fieldnav.mission.taped_camera import taped_cameras
from fieldnav.replay.foreign.beginning import ANEW, BEHIND, begin, begin_anew
from fieldnav.replay.foreign.camera import AbsentCamera
from fieldnav.replay.foreign.ground_speed import GroundSpeed
from fieldnav.replay.foreign.left_out import LeftOut, replayed_until
from fieldnav.replay.foreign.order import Order
from fieldnav.replay.foreign.sightings import Seen, Sightings
from fieldnav.replay.foreign.wheels import AssumedWheels
from states.behaviour import Task
from states.names import Event

Tell = Callable[[float, float], None]
"""Told the second of the recording that is replayed, and its last."""
ENDED = "the recording ends here"
NAME_LENGTH = 60
"""Of a run directory's name, which file systems bound."""


@dataclass(frozen=True, slots=True)
class Driven:
    """A foreign replay that has ended.

    ground_share: of the assumed speed, at which the ground moves through the pictures, if that is known.
    said: what a person should know of the cameras. left_out: whether much of the recording was not looked at.
    """

    directory: RunDirectory
    summary: Summary
    seen: Seen
    ground_share: float | None
    said: tuple[str, ...]
    left_out: bool


def drive(order: Order, tell: Tell | None = None) -> Driven:
    """Drive to the end of the recording, or to where the mission ends.

    Raises OutputError, and SettingsError where a file turns out to be broken: what was driven is kept.
    """
    cv2.setNumThreads(1)
    begun_utc = order.begun_utc
    directory = RunDirectory.create(order.parent, _named(order.name), datetime.now(UTC))
    write_settings(directory.settings, order.crop, order.robot, options=order.options)
    absent = {name: AbsentCamera(name) for name in CameraName if name not in order.cameras}
    figures, sightings, ground = Figures(order.lanes), Sightings(), GroundSpeed(order.robot)
    with ExitStack() as stack:
        tape = stack.enter_context(taping(directory, order.robot, begun_utc, order.record, waits=True))
        journal = stack.enter_context(Journal(directory.journal, begun_utc, tape.line))
        mission = Mission(
            order.robot,
            _task(order),
            taped_cameras(tape, _both(order, absent), order.robot),
            AssumedWheels(order.robot, order.moved),
            journal,
            [figures, sightings, ground, tape],
            commanding=False,
        )
        started = time.perf_counter()
        try:
            _go(mission, order, tape, tell)
        finally:
            summary = figures.summary(time.perf_counter() - started, Headland(), None)
            write_summary(directory.summary, summary)
    left_out = LeftOut(order.cameras.values(), order.again, summary.completed)
    said = (*order.notes, *_told(order), *left_out.said, *(each.said for each in absent.values()))
    much = left_out.much or not sightings.seen.frames
    return Driven(directory, summary, sightings.seen, ground.share, said, much)


def _told(order: Order) -> list[str]:
    """What is to be told of the stamps and the pictures."""
    return [*order.timeline.steps, *(note for camera in order.cameras.values() for note in camera.notes)]


def _go(mission: Mission, order: Order, tape: Tape, tell: Tell | None) -> None:
    operating = Operating(mission, tape)
    begin(mission, operating, 0.0, order.direction)
    ticks = 0
    while order.again or not mission.over:
        ticks += 1
        now_s = ticks * TICK_S
        try:
            if not _more(mission, operating, order, now_s):
                operating.end(now_s, ENDED)
                return
            operating.tick(now_s)
        except KeyboardInterrupt:
            operating.break_off(now_s, Event.FAIL, "interrupted by the operator")
            raise
        except SettingsError as error:
            operating.end(now_s, str(error))
            raise SettingsError(f"{error}; {replayed_until(order.cameras.values())}") from error
        if tell is not None:
            tell(now_s, order.seconds)


def _more(mission: Mission, operating: Operating, order: Order, now_s: float) -> bool:
    """Read on to this time; whether there is more of the recording. Raises SettingsError for a broken file.

    All that can be broken is read here, and not within a round, whose faults are the robot's. A mission that
    stands begins anew behind a step in the stamps, and, where that is asked, with the next picture.
    """
    timeline = order.timeline
    if timeline.ended(now_s):
        return False
    if step := timeline.step(now_s):
        operating.end(now_s, step)
        timeline.step_over(now_s)
        begin_anew(mission, operating, now_s, order.direction, BEHIND)
    came = timeline.advance(now_s)
    order.moved(now_s)
    if order.again and not mission.course.moving and came[order.direction.leading]:
        begin_anew(mission, operating, now_s, order.direction, ANEW)
    if not mission.course.moving:
        for name, count in came.items():
            order.cameras[name].counts.idle += count
    return True


def _both(order: Order, absent: dict[CameraName, AbsentCamera]) -> dict[CameraName, Camera]:
    return {name: absent[name] if name in absent else order.cameras[name] for name in CameraName}


def _task(order: Order) -> Task:
    pinholes = order.robot.cameras.pinholes()
    return Task(order.crop, pinholes, order.side, order.lanes)


def _named(source: str) -> str:
    """A run's name: the recording's, without what names of files had better not hold."""
    stem = re.sub(r"[^A-Za-z0-9._-]+", "-", Path(source).resolve().stem).strip("-.")
    return f"replay-{stem[:NAME_LENGTH]}"
