"""What comes to a mission from outside and what goes out of it, on its way into the recording."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from typing import Any

import can

from fieldnav.errors import DriverError, OutputError
from fieldnav.faults import FaultKind
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.ledger import Booking
from fieldnav.messages import CameraName, Frame
from fieldnav.mission.taped import TapedFrame, TapedLine, TapedPinhole, TapedRound, TapedTick
from fieldnav.mission.tick import Tick
from fieldnav.pinhole import Pinhole
from fieldnav.recording.recorder import Recorder
from fieldnav.recording.records import Call, Lost, Seen
from fieldnav.settings.robot import Robot

EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


class Tape:
    """Gathers each round, one call of the mission with all that it took in and gave out; also an observer.

    Without a recorder it does nothing.
    """

    def __init__(self, recorder: Recorder | None = None, begun_utc: datetime = EPOCH) -> None:
        """begun_utc: the run's second 0."""
        self._recorder = self._closing = recorder
        self._begun_utc = begun_utc
        self._round: TapedRound | None = None
        self._number = 0
        self._skies_px: dict[CameraName, float] = {}

    @contextmanager
    def round(
        self,
        call: Call,
        now_s: float,
        by: str = "",
        fault: FaultKind | None = None,
        latched: bool = False,
        booking: Booking | None = None,
    ) -> Iterator[None]:
        """All that passes within belongs to this call. What passes outside any round is not kept."""
        if self._recorder is None:
            yield
            return
        self._round = TapedRound(call, now_s, self._number, by, fault, latched, booking)
        self._number += 1
        try:
            yield
        finally:
            if self._recorder is not None:
                self._recorder.put(self._round)
            self._round = None

    def clock(self, clock: Callable[[], float]) -> Callable[[], float]:
        """A clock; what it tells in a round is taped."""

        def read_s() -> float:
            told_s = clock()
            if self._round is not None:
                self._round.reads_s.append(told_s)
            return told_s

        return read_s

    def frame(self, frame: Frame) -> None:
        """A frame was taken in."""
        if self._recorder is not None and self._round is not None:
            seen = Seen.of(frame)
            self._recorder.put(TapedFrame(seen, frame.jpeg or b"", self._begun_utc))
            self._round.frames.append(seen)

    def lost(self, camera: CameraName, error: DriverError) -> None:
        """A camera gave none."""
        if self._round is not None:
            self._round.lost.append(Lost(camera=camera, fault=error.fault, said=str(error)))

    def wire(self, frame: can.Message, sent: bool) -> None:
        """A CAN frame passed."""
        if self._round is not None:
            self._round.wires.append((sent, frame))

    def refused(self, error: Exception, sent: bool) -> None:
        """The bus failed instead."""
        if self._round is not None:
            self._round.wires.append((sent, str(error)))

    def line(self, line: dict[str, Any]) -> None:
        """The journal has a new line."""
        if self._recorder is not None:
            self._recorder.put(TapedLine(line, self._begun_utc))
        if self._round is not None:
            self._round.lines.append(line["seq"])

    def watch(self, tick: Tick) -> None:
        """A tick has ended. Raises OutputError, once, when the recording has ended before the run."""
        if self._recorder is None:
            return
        if self._recorder.failure is not None:
            said, self._recorder = self._recorder.failure, None
            raise OutputError(said)
        self._recorder.put(TapedTick.of(tick, self._begun_utc, self._skies_px))

    def sees(self, camera: CameraName, pinhole: Pinhole) -> None:
        """How a camera sees."""
        self._skies_px[camera] = pinhole.sky_px
        if self._recorder is not None:
            self._recorder.put(TapedPinhole(camera, pinhole, self._begun_utc))

    @property
    def runs(self) -> bool:
        """Whether anybody records."""
        return self._recorder is not None

    def end(self) -> tuple[str, ...]:
        """Write what waits and complete the recording; what a person should know of it. May be repeated."""
        if self._closing is None:
            return ()
        closing, self._closing = self._closing, None
        closing.close()
        return tuple(said for said in (closing.failure, *closing.notes) if said)


@contextmanager
def taping(
    directory: RunDirectory, robot: Robot, begun_utc: datetime, record: bool, waits: bool
) -> Iterator[Tape]:
    """A tape that is recorded into the run's directory, or, if nothing is to be recorded, by nobody.

    waits: in simulation, where time stands still meanwhile; a robot does not wait for its disk.
    """
    if not record:
        yield Tape()
        return
    tape = Tape(Recorder(directory, robot.recording, begun_utc, waits), begun_utc)
    try:
        yield tape
    finally:
        tape.end()
