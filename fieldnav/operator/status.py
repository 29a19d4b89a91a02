"""How a mission stands, as the operator is told it."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Status:
    """A mission at one moment; a figure that nobody knows is None.

    since_s: seconds since the state was entered; lane: counted from 1; speed_mps: what the wheels are told;
    lateness_s: the loop's worst since the run began, or over as long as the loop remembers.
    """

    run: str
    state: str
    since_s: float | None
    lane: int
    lanes: int
    rows: int
    distance_m: float | None
    speed_mps: float | None
    reason: str = ""
    warnings: tuple[str, ...] = ()
    battery_percent: float | None = None
    lateness_s: float | None = None
