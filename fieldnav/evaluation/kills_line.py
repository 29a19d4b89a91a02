"""The line between a mission's process and its world's: what crosses it, and the mission's end of it.

Lock-step: the mission says up to when the world may go on, and gets what the modules said by then.
"""

from collections import deque
from dataclasses import dataclass
from multiprocessing.connection import Connection

import can
import numpy as np

from fieldnav.messages import CameraName, Frame
from states.names import Path as StatePath

WireFrame = tuple[float, int, bytes]
"""Stamp, identifier of 11 bits, data."""


@dataclass(frozen=True, slots=True)
class Advance:
    """Take the frames and go on to a time; where the mission stood before is told along, for the record."""

    until_s: float
    frames: tuple[WireFrame, ...]
    state: StatePath
    lane: int
    rows_passed: int


@dataclass(frozen=True, slots=True)
class Look:
    """Give the newest picture; the answer is None for the one that was given last."""

    camera: CameraName
    now_s: float


@dataclass(frozen=True, slots=True)
class Ended:
    """The mission is over and stands; the state that it ended in."""

    state: StatePath


class QueuedBus(can.BusABC):
    """One end of a bus: what was sent waits until it is taken, what has arrived until it is received."""

    def __init__(self) -> None:
        super().__init__(channel="line")
        self.channel_info = "a queue"
        self._arrived: deque[can.Message] = deque()
        self._sent: list[WireFrame] = []

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        self._sent.append((msg.timestamp, msg.arbitration_id, bytes(msg.data)))

    def taken(self) -> tuple[WireFrame, ...]:
        """What was sent since the last time."""
        sent, self._sent = tuple(self._sent), []
        return sent

    def arrive(self, frames: tuple[WireFrame, ...]) -> None:
        """Take in what the other end sent."""
        for stamp_s, identifier, data in frames:
            self._arrived.append(can.Message(stamp_s, identifier, is_extended_id=False, data=data))

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        """Never waits: in lock-step all that can have come has come."""
        return (self._arrived.popleft() if self._arrived else None), False


class LineCamera:
    """The Camera port over the line."""

    def __init__(self, name: CameraName, line: Connection) -> None:
        self._name, self._line = name, line
        self._frame: Frame | None = None

    def latest(self, now_s: float) -> Frame | None:
        self._line.send(Look(self._name, now_s))
        head = self._line.recv()
        if head is not None:
            sequence, stamp_s, shape = head
            image = np.empty(shape, np.uint8)
            self._line.recv_bytes_into(image.reshape(-1).data)
            self._frame = Frame(self._name, sequence, stamp_s, image)
        return self._frame

    def close(self) -> None:
        """The line is not the camera's."""
