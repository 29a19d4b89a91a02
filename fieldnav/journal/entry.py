"""What the journal holds: an entry as the loop hands it over, and the line it becomes."""

from dataclasses import dataclass
from datetime import datetime, timedelta
from math import isfinite
from typing import Any

from pydantic import BaseModel, ConfigDict

from fieldnav.messages import Evidence, Frame, Twist

DIGITS = 6
"""Decimals kept of a number: a micrometre, a microsecond; below lies noise that differs between machines."""


@dataclass(frozen=True, slots=True)
class Entry:
    """A transition or a notable event: decided on which `frame`, and the `command` the wheels get."""

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


class Judged(BaseModel):
    """One quantity as read back; a value that was not a number is None."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)

    name: str
    value: float | None
    threshold: float | None = None
    unit: str = ""


class Line(BaseModel):
    """One line of a journal as read back; keys of later versions are passed over."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)

    seq: int
    stamp_s: float
    utc: datetime
    event: str
    source: str
    target: str
    lane: int | None = None
    rows: int | None = None
    evidence: tuple[Judged, ...] = ()
    frame: dict[str, str | int | float | None] | None = None
    command: dict[str, float | None] | None = None
    reason: str = ""


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
        "evidence": [
            {
                "name": judged.name,
                "value": _number(judged.value),
                "threshold": _number(judged.threshold),
                "unit": judged.unit,
            }
            for judged in entry.evidence
        ],
        "frame": frame
        and {"camera": frame.camera.value, "sequence": frame.sequence, "stamp_s": _number(frame.stamp_s)},
        "command": command
        and {
            "vx_mps": _number(command.vx_mps),
            "vy_mps": _number(command.vy_mps),
            "yaw_rate_rps": _number(command.yaw_rate_rps),
        },
        "reason": entry.reason,
    }


def _number(value: float | None) -> float | None:
    """A number as JSON knows it: what is not finite becomes null, and minus zero plain zero."""
    return round(float(value), DIGITS) + 0.0 if value is not None and isfinite(value) else None
