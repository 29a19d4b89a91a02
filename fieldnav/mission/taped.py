"""What a tape hands to the recorder; it becomes messages on the recorder's own thread."""

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from typing import Any

import can

from fieldnav.faults import FaultKind
from fieldnav.journal.ledger import Booking
from fieldnav.messages import CameraName, Frame
from fieldnav.mission.tick import Tick
from fieldnav.mission.ticked import caption, stepped, ticked
from fieldnav.pinhole import Pinhole
from fieldnav.recording.foxglove import Level, calibration, compressed_image, log, pose
from fieldnav.recording.foxglove_overlay import overlay
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.records import Call, Lost, Round, Seen, Wire
from states.names import Event

SMALL_BYTES = 4096
"""About what a tick holds in memory while it waits; its picture waits by itself."""
STOPS = {Event.FAIL.value: Level.ERROR, Event.LATCH.value: Level.FATAL, Event.PAUSE.value: Level.WARNING}


@dataclass(slots=True)
class TapedRound:
    """See records.Round. wires: whether it was sent, and the frame or what the bus said instead."""

    call: Call
    now_s: float
    by: str = ""
    fault: FaultKind | None = None
    latched: bool = False
    booking: Booking | None = None
    frames: list[Frame] = field(default_factory=list)
    lost: list[Lost] = field(default_factory=list)
    wires: list[tuple[bool, can.Message | str]] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)
    size: int = SMALL_BYTES
    picture: bool = False

    def messages(self) -> Iterator[Message]:
        record = Round(
            call=self.call,
            now_s=self.now_s,
            by=self.by,
            fault=self.fault,
            latched=self.latched,
            frames=tuple(seen(frame) for frame in self.frames),
            lost=tuple(self.lost),
            wires=tuple(
                Wire(sent=sent, error=what) if isinstance(what, str) else Wire.of(what, sent)
                for sent, what in self.wires
            ),
            lines=tuple(self.lines),
            booking=self.booking,
        )
        content = record.model_dump_json(exclude_defaults=True).encode()
        yield Message(Topic.ROUND, self.now_s, content)


@dataclass(frozen=True, slots=True)
class TapedFrame:
    """A picture that the mission has taken in."""

    frame: Frame
    begun_utc: datetime
    picture: bool = True

    @property
    def size(self) -> int:
        """The compressed picture's; the other one is the mission's as well."""
        return len(self.frame.jpeg or b"")

    def messages(self) -> Iterator[Message]:
        frame = self.frame
        utc = self.begun_utc + timedelta(seconds=frame.stamp_s)
        content = compressed_image(frame.camera, utc, frame.jpeg or b"")
        yield Message(Topic.image(frame.camera), frame.stamp_s, content, frame.sequence)


@dataclass(frozen=True, slots=True)
class TapedTick:
    """How the mission stood after a tick, and, on a fresh look, what was judged and seen."""

    tick: Tick
    begun_utc: datetime
    size: int = SMALL_BYTES
    picture: bool = False

    def messages(self) -> Iterator[Message]:
        tick, sight = self.tick, self.tick.step.sight
        utc = self.begun_utc + timedelta(seconds=tick.now_s)
        yield Message(Topic.TICK, tick.now_s, ticked(tick).model_dump_json(exclude_defaults=True).encode())
        at = tick.pose
        yield Message(Topic.POSE, tick.now_s, pose(utc, at.x_m, at.y_m, at.heading_rad))
        if tick.step.evidence or sight is not None:
            content = stepped(tick).model_dump_json(exclude_defaults=True).encode()
            yield Message(Topic.STEP, tick.now_s, content)
        if sight is not None:
            frame = sight.frame
            seen_utc = self.begun_utc + timedelta(seconds=frame.stamp_s)
            height, width = frame.image.shape[:2]
            line = sight.feature.line(width, height) if sight.feature else None
            drawn = overlay(seen_utc, (width, height), sight.rows, sight.centres, line, caption(tick))
            yield Message(Topic.overlay(frame.camera), frame.stamp_s, drawn, frame.sequence)


@dataclass(frozen=True, slots=True)
class TapedLine:
    """A line of the journal, for programs and as a line of the log to read."""

    line: dict[str, Any]
    begun_utc: datetime
    size: int = SMALL_BYTES
    picture: bool = False

    def messages(self) -> Iterator[Message]:
        line, stamp_s = self.line, self.line["stamp_s"]
        yield Message(Topic.TRANSITION, stamp_s, json.dumps(line, allow_nan=False).encode())
        places = dict.fromkeys((line["source"], line["target"]))
        said = ": ".join(part for part in (line["event"], " -> ".join(places), line["reason"]) if part)
        utc = self.begun_utc + timedelta(seconds=stamp_s)
        yield Message(Topic.LOG, stamp_s, log(utc, STOPS.get(line["event"], Level.INFO), "mission", said))


@dataclass(frozen=True, slots=True)
class TapedPinhole:
    """How a camera sees."""

    camera: CameraName
    pinhole: Pinhole
    begun_utc: datetime
    size: int = SMALL_BYTES
    picture: bool = False

    def messages(self) -> Iterator[Message]:
        yield Message(
            Topic.calibration(self.camera), 0.0, calibration(self.camera, self.begun_utc, self.pinhole)
        )


def seen(frame: Frame) -> Seen:
    """Which frame it is."""
    return Seen(camera=frame.camera, sequence=frame.sequence, stamp_s=frame.stamp_s)
