"""How well the rows were seen in a recording, counted as it is replayed."""

from math import sqrt

from pydantic import BaseModel, ConfigDict

from fieldnav.mission.tick import Tick
from states.names import Follow

ROWS, OFFSET, HEADING = "rows seen", "offset from the lane", "heading against the lane"
"""The quantities of Follow.Tracking that are counted."""


class Seen(BaseModel):
    """Figures of the frames in which rows were tracked; None where none were.

    frames: those that were looked at while the lane was followed; with_rows: in which at least half of the
    lane's rows were seen. Offset to the left and heading counter-clockwise: the robot's, in its lane.
    """

    model_config = ConfigDict(frozen=True)

    frames: int = 0
    with_rows: int = 0
    offset_m: float | None = None
    offset_sd_m: float | None = None
    heading_deg: float | None = None
    heading_sd_deg: float | None = None

    @property
    def share(self) -> float:
        """Of the frames, in which rows were seen; 0 where there were no frames."""
        return self.with_rows / self.frames if self.frames else 0.0


class Sightings:
    """An observer of the mission."""

    def __init__(self) -> None:
        self._frames = self._with_rows = 0
        self._offset, self._heading = _Mean(), _Mean()

    def watch(self, tick: Tick) -> None:
        """Take in what was judged on a fresh frame of the leading camera."""
        state = tick.change.source if tick.change else tick.state
        if tick.step.sight is None or not any(each in state for each in Follow):
            return
        self._frames += 1
        if Follow.TRACKING not in state:
            return
        judged = {each.name: each for each in tick.step.evidence}
        rows = judged.get(ROWS)
        if rows is None or rows.threshold is None or rows.value < rows.threshold:
            return
        self._with_rows += 1
        if OFFSET in judged and HEADING in judged:  # the paper's law knows neither in metres
            self._offset.add(judged[OFFSET].value)
            self._heading.add(judged[HEADING].value)

    @property
    def seen(self) -> Seen:
        """The figures so far."""
        return Seen(
            frames=self._frames,
            with_rows=self._with_rows,
            offset_m=self._offset.mean,
            offset_sd_m=self._offset.deviation,
            heading_deg=self._heading.mean,
            heading_sd_deg=self._heading.deviation,
        )


class _Mean:
    """Mean and standard deviation; None before the first value."""

    def __init__(self) -> None:
        self._count, self._sum, self._squares = 0, 0.0, 0.0

    def add(self, value: float) -> None:
        self._count += 1
        self._sum += value
        self._squares += value * value

    @property
    def mean(self) -> float | None:
        return self._sum / self._count if self._count else None

    @property
    def deviation(self) -> float | None:
        mean = self.mean
        return None if mean is None else sqrt(max(0.0, self._squares / self._count - mean * mean))
