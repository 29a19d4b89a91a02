"""A made-up recording: ticks, steps, and a grey picture for each step."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

import cv2
import numpy as np

from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry, Judged
from fieldnav.messages import Bound, CameraName, Wheel
from fieldnav.recording.foxglove import compressed_image
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.recorder import Recorder
from fieldnav.recording.records import Line, Module, Seen, Stepped, Ticked
from fieldnav.settings.recording import RecordingSettings

BEGUN = datetime(2026, 5, 1, 8, 30, tzinfo=UTC)


@dataclass(frozen=True, slots=True)
class Item:
    """Something to record, as it is."""

    parts: tuple[Message, ...]
    picture: bool = False

    @property
    def size(self) -> int:
        return sum(len(part.data) for part in self.parts)

    def messages(self) -> Iterable[Message]:
        return self.parts


def state_at(now_s: float, lines: Sequence[Entry]) -> Entry:
    """The line after which the story stands at a time."""
    return [line for line in lines if line.stamp_s <= now_s and line.source != line.target][-1]


def ticked(now_s: float, lines: Sequence[Entry]) -> Ticked:
    line = state_at(now_s, lines)
    lane = 2 if now_s >= 20 else 1
    return Ticked(
        now_s=now_s,
        state=line.target,
        lane=lane,
        rows=3,
        rows_passed=3 if "Crossing" in line.target and now_s > 16 else 0,
        forward_m=0.0,
        sideways_m=0.0,
        x_m=min(now_s, 12.0) / 2,
        y_m=-max(0.0, min(now_s - 12, 8)) * 0.2,
        heading_rad=0.0,
        vx_mps=0.5 if "Follow" in line.target else 0.0,
        vy_mps=-0.15 if "Crossing" in line.target else 0.0,
        yaw_rate_rps=0.0,
        modules={Wheel.FRONT_LEFT: Module(battery_v=52.5, temperature_c=31.0)},
        charge_percent=80.0 - now_s / 10,
    )


def stepped(sequence: int, now_s: float, lines: Sequence[Entry], unseen_m: float = 0.0) -> Stepped:
    """2 cm and 1 degree off in every frame; the rows poorly seen over what is given, of 0.25 m."""
    line = state_at(now_s, lines)
    unseen = Judged(
        name="rows poorly seen over",
        value=unseen_m,
        threshold=0.25,
        unit="m",
        fires="rows lost",
        bound=Bound.ABOVE,
    )
    return Stepped(
        now_s=now_s,
        state=line.target,
        lane=2 if now_s >= 20 else 1,
        forward_m=0.0,
        evidence=(
            Judged(name="offset from the lane", value=-0.02, unit="m"),
            Judged(name="heading against the lane", value=1.0, unit="deg"),
            unseen,
        ),
        frame=Seen(camera=CameraName.FRONT, sequence=sequence, stamp_s=now_s - 0.1),
        rows=tuple(Line(x_top_px=30.0, x_bottom_px=20.0, confidence=sure) for sure in (0.9, 0.9, 0.0)),
        plants=17,
    )


def record(directory: RunDirectory, ticks: Sequence[Ticked], steps: Sequence[Stepped]) -> None:
    """Tape ticks and steps, each step with a picture of its frame."""
    jpeg = cv2.imencode(".jpg", np.full((96, 128, 3), 120, np.uint8))[1].tobytes()
    timed: list[tuple[float, Item]] = []
    for tick in ticks:
        data = tick.model_dump_json().encode()
        timed.append((tick.now_s, Item((Message(Topic.TICK, tick.now_s, data),))))
    for step in steps:
        timed.append((step.now_s, Item((Message(Topic.STEP, step.now_s, step.model_dump_json().encode()),))))
        if (seen := step.frame) is not None:
            data = compressed_image(seen.camera, BEGUN + timedelta(seconds=seen.stamp_s), jpeg)
            picture = Message(Topic.image(seen.camera), seen.stamp_s, data, seen.sequence)
            timed.append((seen.stamp_s, Item((picture,), picture=True)))
    with Recorder(directory, RecordingSettings(keep_free_gb=0), BEGUN, waits=True) as recorder:
        for _, item in sorted(timed, key=lambda each: each[0]):
            recorder.put(item)
    assert recorder.failure is None
