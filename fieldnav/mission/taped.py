"""What a tape hands to the recorder; it becomes messages on the recorder's own thread."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime, timedelta
from typing import Any, Self

import can
import numpy as np

from fieldnav.faults import FaultKind
from fieldnav.journal.ledger import Booking
from fieldnav.messages import CameraName
from fieldnav.mission.tick import Tick
from fieldnav.mission.ticked import caption, stepped, ticked
from fieldnav.pinhole import Pinhole
from fieldnav.recording.foxglove import Level, calibration, compressed_image, log, pose
from fieldnav.recording.foxglove_overlay import overlay
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.records import Call, Lost, Round, Seen, Wire
from states.names import Event

NO_IMAGE = np.empty((0, 0, 3), np.uint8)
SMALL_BYTES = 4096
"""About what a tick holds in memory while it waits; its picture waits by itself."""
USUAL_WIRES, WIRE_BYTES = 16, 600
"""CAN frames of a round that are within that, and what each more holds, as on a bus that is flooded."""
STOPS = {Event.FAIL.value: Level.ERROR, Event.LATCH.value: Level.FATAL, Event.PAUSE.value: Level.WARNING}


@dataclass(slots=True)
class TapedRound:
    """See records.Round. wires: whether it was sent, and the frame or what the bus said instead."""

    call: Call
    now_s: float
    number: int
    by: str = ""
    fault: FaultKind | None = None
    latched: bool = False
    booking: Booking | None = None
    frames: list[Seen] = field(default_factory=list)
    lost: list[Lost] = field(default_factory=list)
    wires: list[tuple[bool, can.Message | str]] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)
    reads_s: list[float] = field(default_factory=list)
    picture: bool = False

    @property
    def size(self) -> int:
        return SMALL_BYTES + WIRE_BYTES * max(0, len(self.wires) - USUAL_WIRES)

    def messages(self) -> Iterator[Message]:
        record = Round(
            call=self.call,
            now_s=self.now_s,
            number=self.number,
            by=self.by,
            fault=self.fault,
            latched=self.latched,
            frames=tuple(self.frames),
            lost=tuple(self.lost),
            wires=tuple(
                Wire(sent=sent, error=what) if isinstance(what, str) else Wire.of(what, sent)
                for sent, what in self.wires
            ),
            lines=tuple(self.lines),
            booking=self.booking,
            reads_s=tuple(self.reads_s),
        )
        content = record.model_dump_json(exclude_defaults=True).encode()
        yield Message(Topic.ROUND, self.now_s, content)


@dataclass(frozen=True, slots=True)
class TapedFrame:
    """A picture that the mission has taken in, compressed."""

    seen: Seen
    jpeg: bytes
    begun_utc: datetime
    picture: bool = True

    @property
    def size(self) -> int:
        return len(self.jpeg)

    def messages(self) -> Iterator[Message]:
        seen = self.seen
        content = compressed_image(seen.camera, self.begun_utc + timedelta(seconds=seen.stamp_s), self.jpeg)
        yield Message(Topic.image(seen.camera), seen.stamp_s, content, seen.sequence)


@dataclass(frozen=True, slots=True)
class TapedTick:
    """How the mission stood after a tick, and, on a fresh look, what was judged and seen.

    The picture is not held while this waits; size_px: its width and height; sky_px: see `overlay`.
    """

    tick: Tick
    begun_utc: datetime
    size_px: tuple[int, int]
    sky_px: float = 0.0
    size: int = SMALL_BYTES
    picture: bool = False

    @classmethod
    def of(cls, tick: Tick, begun_utc: datetime, skies_px: Mapping[CameraName, float]) -> Self:
        """The tick, without its picture; skies_px: of the cameras in whose pictures some is."""
        step, sight = tick.step, tick.step.sight
        if sight is None:
            return cls(tick, begun_utc, (0, 0))
        height, width = sight.frame.image.shape[:2]
        sky_px = skies_px.get(sight.frame.camera, 0.0)
        blind = replace(sight, frame=replace(sight.frame, image=NO_IMAGE, jpeg=None))
        return cls(replace(tick, step=replace(step, sight=blind)), begun_utc, (width, height), sky_px)

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
            line = sight.feature.line(*self.size_px) if sight.feature else None
            drawn = overlay(
                seen_utc, self.size_px, sight.rows, sight.centres, line, caption(tick), self.sky_px
            )
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
