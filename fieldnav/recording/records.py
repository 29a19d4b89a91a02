"""The records of a recording as they are read back. Keys of later versions are passed over."""

from enum import Enum
from math import hypot
from typing import Self

import can
from pydantic import BaseModel, ConfigDict

from fieldnav.faults import FaultKind
from fieldnav.journal.entry import Judged
from fieldnav.journal.ledger import Booking
from fieldnav.messages import STANDSTILL, CameraName, Frame, Twist, Wheel


class Record(BaseModel):
    """Frozen; what is not finite is written as null."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)


class Call(Enum):
    """What is done to a mission from outside, round by round and by a person."""

    TAKE_UP = "take up"
    START = "start"
    TICK = "tick"
    PAUSE = "pause"
    RESUME = "resume"
    RESET = "reset"
    END = "end"
    BREAK_OFF = "break off"
    NOTE = "note"


class Seen(Record):
    """Which frame: a camera's number of it, and when it was taken."""

    camera: CameraName
    sequence: int
    stamp_s: float

    @classmethod
    def of(cls, frame: Frame) -> Self:
        """Of a frame itself."""
        return cls(camera=frame.camera, sequence=frame.sequence, stamp_s=frame.stamp_s)


class Lost(Record):
    """A camera that gave no frame, and why."""

    camera: CameraName
    fault: FaultKind
    said: str


class Wire(Record):
    """One CAN frame, or, with an `error`, what the bus said instead of taking or giving one; data in hex."""

    sent: bool
    id: int = 0
    extended: bool = False
    remote: bool = False
    error_frame: bool = False
    data: str = ""
    stamp_s: float = 0.0
    error: str = ""

    @classmethod
    def of(cls, frame: can.Message, sent: bool) -> Self:
        """The record of a frame of python-can."""
        return cls(
            sent=sent,
            id=frame.arbitration_id,
            extended=frame.is_extended_id,
            remote=frame.is_remote_frame,
            error_frame=frame.is_error_frame,
            data=bytes(frame.data).hex(),
            stamp_s=frame.timestamp,
        )

    def message(self) -> can.Message:
        """The frame as python-can has it."""
        return can.Message(
            timestamp=self.stamp_s,
            arbitration_id=self.id,
            is_extended_id=self.extended,
            is_remote_frame=self.remote,
            is_error_frame=self.error_frame,
            data=bytes.fromhex(self.data),
        )


class Round(Record):
    """One call of the mission with all that it took in and gave out, in order: enough to do it again.

    number: counts the rounds of one process. by: who asked, or why. fault: of a note. latched: of a
    break-off. lines: the numbers of the lines in the journal that came of it. booking: the place at which a
    run that was broken off is taken up. reads_s: what the clock told, each time that it was looked at.
    """

    call: Call
    now_s: float
    number: int = 0
    by: str = ""
    fault: FaultKind | None = None
    latched: bool = False
    frames: tuple[Seen, ...] = ()
    lost: tuple[Lost, ...] = ()
    wires: tuple[Wire, ...] = ()
    lines: tuple[int, ...] = ()
    booking: Booking | None = None
    reads_s: tuple[float, ...] = ()


class Module(Record):
    """One wheel module: what it was told and what it said."""

    set_speed_mps: float | None = None
    set_steering_rad: float | None = None
    speed_mps: float | None = None
    steering_rad: float | None = None
    temperature_c: float | None = None
    battery_v: float | None = None


class Ticked(Record):
    """How the mission stood after a tick: state, place by dead reckoning, command, wheels.

    vx_mps, vy_mps, yaw_rate_rps: what is wanted; with `hold` the wheels only turn into place for it.
    """

    now_s: float
    state: str
    lane: int
    rows: int
    rows_passed: int
    forward_m: float
    sideways_m: float
    x_m: float
    y_m: float
    heading_rad: float
    vx_mps: float
    vy_mps: float
    yaw_rate_rps: float
    hold: bool = False
    refused: str = ""
    warning: str = ""
    modules: dict[Wheel, Module] = {}
    charge_percent: float | None = None

    @property
    def told(self) -> Twist:
        """What the wheels were told to do."""
        return STANDSTILL if self.hold else Twist(self.vx_mps, self.vy_mps, self.yaw_rate_rps)

    @property
    def told_mps(self) -> float:
        """Its speed."""
        return hypot(self.told.vx_mps, self.told.vy_mps)


class Line(Record):
    """A crop row in a picture, see messages.RowLine."""

    x_top_px: float
    x_bottom_px: float
    confidence: float


class Stepped(Record):
    """What a state judged, and on which frame, if any; `event`: what came of it, empty where nothing did."""

    now_s: float
    state: str
    lane: int
    forward_m: float
    event: str = ""
    reason: str = ""
    evidence: tuple[Judged, ...] = ()
    frame: Seen | None = None
    rows: tuple[Line, ...] = ()
    plants: int | None = None


class Gap(Record):
    """Pictures that are not in the recording because the disk was too slow."""

    from_s: float
    to_s: float
    frames: int
