"""What the journal holds: an entry as the loop hands it over, and the line it becomes."""

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from math import isfinite
from typing import Annotated, Any, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from fieldnav.messages import Bound, Evidence, Frame, Twist

DIGITS = 6
"""Decimals kept of a number: a micrometre, a microsecond; below lies noise that differs between machines."""
MAX_STAMP_S = 1e10
"""Of a run's line: 300 years, since a run that is taken up may have begun by a clock that stood at 1970."""
MAX_LANES, MAX_ROWS, MAX_WAY_M = 1000, 1000, 1e7
"""Of one mission: a thousand lanes of the longest field are 2000 km."""
FIRST_UTC, LAST_UTC = datetime(1970, 1, 1, tzinfo=UTC), datetime(2200, 1, 1, tzinfo=UTC)
"""What a clock may show; with the longest run beside it still a time that can be reckoned with."""
MAX_SEQUENCE = 2**53
"""What every reader of JSON keeps exactly."""


def _of_a_clock(utc: datetime) -> datetime:
    if utc.tzinfo is None:
        raise ValueError("allowed is a time with its zone")
    if not FIRST_UTC <= utc <= LAST_UTC:
        raise ValueError(f"allowed is a time from {FIRST_UTC.year} to {LAST_UTC.year}")
    return utc


@dataclass(frozen=True, slots=True)
class Entry:
    """A transition or a notable event: decided on which `frame`, and the `command` the wheels get.

    forward_m, sideways_m: what the wheels had travelled since the run began, signed in the robot's axes.
    """

    stamp_s: float
    event: str
    source: str
    target: str
    lane: int | None = None
    rows: int | None = None
    evidence: tuple[Evidence, ...] = ()
    frame: Frame | None = None
    command: Twist | None = None
    reason: str = ""
    forward_m: float | None = None
    sideways_m: float | None = None


class Judged(BaseModel):
    """One quantity as read back, see messages.Evidence; a value that was not a number is None."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)

    name: str
    value: float | None
    threshold: float | None = None
    unit: str = ""
    fires: str = ""
    bound: Bound = Bound.AT_LEAST
    alone: bool = False

    @classmethod
    def of(cls, evidence: Evidence) -> Self:
        """A quantity as it will be read back."""
        return cls.model_validate(judged_as_json(evidence))

    @property
    def margin(self) -> float | None:
        """How far the value lies beyond its threshold, in its unit: negative where the condition fails."""
        if self.value is None or self.threshold is None or not self.fires:
            return None
        return self.bound.sign * (self.value - self.threshold)

    @property
    def holds(self) -> bool:
        """Whether the condition that it is holds."""
        known = self.value is not None and self.threshold is not None
        return known and self.bound.holds(self.value, self.threshold)  # type: ignore[arg-type]


class Line(BaseModel):
    """One line of a journal as read back; keys of later versions are passed over."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)

    seq: int = Field(ge=0, le=MAX_SEQUENCE)
    stamp_s: float = Field(ge=-MAX_STAMP_S, le=MAX_STAMP_S)
    utc: Annotated[datetime, AfterValidator(_of_a_clock)]
    event: str
    source: str
    target: str
    lane: int | None = Field(default=None, ge=0, le=MAX_LANES)
    rows: int | None = Field(default=None, ge=0, le=MAX_ROWS)
    evidence: tuple[Judged, ...] = ()
    frame: dict[str, str | int | float | None] | None = None
    command: dict[str, float | None] | None = None
    reason: str = ""
    forward_m: float | None = None
    sideways_m: float | None = None


def line_of(entry: Entry, sequence: int, start_utc: datetime) -> dict[str, Any]:
    """An entry as plain JSON values; `utc` is the start plus the stamp, so no clock is read."""
    frame, command = entry.frame, entry.command
    utc = start_utc + timedelta(seconds=round(entry.stamp_s, DIGITS))
    return {
        "seq": sequence,
        "stamp_s": _number(entry.stamp_s),
        "utc": utc.isoformat(timespec="milliseconds").replace("+00:00", "Z"),
        "event": entry.event,
        "source": entry.source,
        "target": entry.target,
        "lane": entry.lane,
        "rows": entry.rows,
        "evidence": [judged_as_json(judged) for judged in entry.evidence],
        "frame": frame
        and {"camera": frame.camera.value, "sequence": frame.sequence, "stamp_s": _number(frame.stamp_s)},
        "command": command
        and {
            "vx_mps": _number(command.vx_mps),
            "vy_mps": _number(command.vy_mps),
            "yaw_rate_rps": _number(command.yaw_rate_rps),
        },
        "reason": entry.reason,
        "forward_m": _number(entry.forward_m),
        "sideways_m": _number(entry.sideways_m),
    }


def judged_as_json(judged: Evidence) -> dict[str, Any]:
    """A quantity as plain JSON values; what it is a condition of only where it is one."""
    value, threshold = _number(judged.value), _number(judged.threshold)
    if judged.fires is not None and value is not None and threshold is not None:
        decided = judged.bound.holds(judged.value, judged.threshold)  # type: ignore[arg-type]
        if judged.bound.holds(value, threshold) != decided:  # rounding must not gainsay what was decided
            value, threshold = float(judged.value), float(judged.threshold)  # type: ignore[arg-type]
    plain = {"name": judged.name, "value": value, "threshold": threshold, "unit": judged.unit}
    if judged.fires is None:
        return plain
    condition = {"fires": judged.fires.value, "bound": judged.bound.value}
    return plain | condition | ({"alone": True} if judged.alone else {})


def _number(value: float | None) -> float | None:
    """A number as JSON knows it: what is not finite becomes null, and minus zero plain zero."""
    return round(float(value), DIGITS) + 0.0 if value is not None and isfinite(value) else None
