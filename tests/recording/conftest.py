"""Recordings of a made-up run: ticks at 50 Hz, pictures of random bytes at 10 Hz."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import CameraName
from fieldnav.recording.foxglove import compressed_image
from fieldnav.recording.message import Message, Recordable, Topic
from fieldnav.recording.recorder import Recorder
from fieldnav.recording.records import Ticked
from fieldnav.settings.recording import RecordingSettings

BEGUN = datetime(2026, 5, 1, 8, 30, 0, 123456, tzinfo=UTC)
TICK_S = 0.02
TICKS_A_PICTURE = 5

Recorded = Callable[..., AbstractContextManager[Recorder]]


@dataclass(frozen=True, slots=True)
class Item:
    """What waits to be recorded."""

    content: Sequence[Message]
    picture: bool = False

    @property
    def size(self) -> int:
        return sum(len(message.data) for message in self.content)

    def messages(self) -> Iterable[Message]:
        return self.content


@dataclass(frozen=True, slots=True)
class MadeUp:
    """What is recorded of the run."""

    begun = BEGUN
    item = Item

    def ticked(self, now_s: float) -> Ticked:
        return Ticked(
            now_s=now_s,
            state="Forward.Follow.Tracking",
            lane=1,
            rows=3,
            rows_passed=0,
            forward_m=now_s / 2,
            sideways_m=0.0,
            x_m=now_s / 2,
            y_m=0.01,
            heading_rad=0.1,
            vx_mps=0.5,
            vy_mps=0.0,
            yaw_rate_rps=0.0,
        )

    def tick(self, now_s: float) -> Recordable:
        return Item([Message(Topic.TICK, now_s, self.ticked(now_s).model_dump_json().encode())])

    def jpeg(self, sequence: int, size: int) -> bytes:
        return np.random.default_rng(sequence).bytes(size)

    def picture(
        self, stamp_s: float, sequence: int, size: int = 1000, camera: CameraName = CameraName.FRONT
    ) -> Recordable:
        data = compressed_image(camera, BEGUN, self.jpeg(sequence, size))
        return Item([Message(Topic.image(camera), stamp_s, data, sequence)], picture=True)

    def items(self, ticks: int, picture_bytes: int = 1000, first: int = 0) -> Iterator[Recordable]:
        for number in range(first, first + ticks):
            if number % TICKS_A_PICTURE == 0:
                yield self.picture(number * TICK_S, number, picture_bytes)
            yield self.tick(number * TICK_S)


@pytest.fixture
def made_up() -> MadeUp:
    return MadeUp()


@pytest.fixture
def directory(tmp_path: Path) -> RunDirectory:
    return RunDirectory(tmp_path)


@pytest.fixture
def recorder(directory: RunDirectory) -> Recorded:
    """Makes a recorder that waits for the disk; settings by name, keep_free_gb being 0."""

    def recorder(settings: dict[str, Any] | None = None, waits: bool = True, **others: Any) -> Recorder:
        allowed = RecordingSettings.model_validate({"keep_free_gb": 0} | (settings or {}))
        return Recorder(directory, allowed, BEGUN, waits, **others)

    return recorder


@pytest.fixture
def record(recorder: Recorded) -> Callable[..., None]:
    """Records items from beginning to end."""

    def record(what: Iterable[Recordable], settings: dict[str, Any] | None = None, **others: Any) -> None:
        with recorder(settings, **others) as writing:
            for item in what:
                writing.put(item)
        assert writing.failure is None

    return record
