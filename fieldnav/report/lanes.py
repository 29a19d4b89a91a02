"""The lanes' table: what was driven in each, and how well, as the robot itself judged it."""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from math import nan

import numpy as np

from fieldnav.inquiry.cause import HELD
from fieldnav.inquiry.quantities import LENGTH, value_of
from fieldnav.inquiry.stops import is_stop
from fieldnav.journal.entry import Line
from fieldnav.journal.ledger import Booking
from fieldnav.messages import Direction, Floats
from fieldnav.report.material import Material
from fieldnav.report.naming import LEFT, LOST, direction_of, in_phase
from fieldnav.report.spans import Span
from fieldnav.report.trail import Trail
from fieldnav.settings.robot import Robot
from states.names import Phase

CM_A_METRE = 100


@dataclass(frozen=True, slots=True)
class Lane:
    """One line of the table; nan or None is what nothing tells.

    headland_m: from the last crop to the leading camera, at the farthest. Confidence, rows and plants are
    means over the frames in which the robot followed the rows.
    """

    number: int
    direction: Direction | None
    done: bool
    seconds: float
    length_m: float | None
    driven_m: float | None
    offset_mean_cm: float
    offset_max_cm: float
    heading_mean_deg: float
    heading_max_deg: float
    confidence: float
    rows_seen: float
    rows_sought: float
    plants: float
    rows_counted: int | None
    headland_m: float | None
    coastings: int
    stops: int

    @property
    def seen(self) -> float:
        """Share of the rows that was seen, over all frames."""
        return self.rows_seen / self.rows_sought if self.rows_sought else nan


def lanes_of(material: Material, spans: Sequence[Span], robot: Robot | None) -> list[Lane]:
    """The lanes that the run came to, in order."""
    numbers = dict.fromkeys(span.lane for span in spans if span.lane is not None and direction_of(span.state))
    return [
        _lane(material, number, [span for span in spans if span.lane == number], robot) for number in numbers
    ]


def _lane(material: Material, number: int, spans: Sequence[Span], robot: Robot | None) -> Lane:
    lines = [line for line in material.lines if line.lane == number]
    left = next((line for line in lines if line.event in LEFT), None)
    travel = next((found for span in spans if (found := direction_of(span.state))), None)
    bookings = [booking for booking in material.bookings if booking.lane == number]
    judged = partial(_judged, material, number)
    offset_cm, heading_deg = np.abs(judged("offset_m")) * CM_A_METRE, np.abs(judged("heading_deg"))
    events = Counter(line.event for line in lines)
    return Lane(
        number=number,
        direction=travel,
        done=left is not None,
        seconds=sum(span.seconds for span in spans if direction_of(span.state)),
        length_m=_length_m(left, bookings),
        driven_m=_driven_m(lines),
        offset_mean_cm=_mean(offset_cm),
        offset_max_cm=_most(offset_cm),
        heading_mean_deg=_mean(heading_deg),
        heading_max_deg=_most(heading_deg),
        confidence=_mean(judged("confidence")),
        rows_seen=_mean(judged("rows_seen")),
        rows_sought=_mean(judged("rows_sought")),
        plants=_mean(judged("plants")),
        rows_counted=_counted(material.trail, number),
        headland_m=_headland_m(bookings, travel, robot),
        coastings=events[LOST],
        stops=events[HELD] + sum(map(is_stop, lines)),
    )


def _judged(material: Material, number: int, column: str) -> Floats:
    """A column over the steps in which the robot followed the rows of a lane, without what is not known."""
    sights = material.sights
    values: Floats = getattr(sights, column)[(sights.lane == number) & (sights.following > 0)]
    return values[np.isfinite(values)]


def _length_m(left: Line | None, bookings: Sequence[Booking]) -> float | None:
    """From the first crop to the last, as judged when the lane was left; else as far as it was booked."""
    judged = value_of(left.evidence, LENGTH) if left else None
    booked = bookings[-1].lane_length_m if bookings else None
    return judged if judged is not None else booked


def _driven_m(lines: Iterable[Line]) -> float | None:
    """How far the robot came along the lane, by its wheels."""
    places = [line.forward_m for line in lines if line.forward_m is not None]
    return max(places) - min(places) if places else None


def _counted(trail: Trail, number: int) -> int | None:
    """Rows that passed in the sidestep out of the lane; None where there was none."""
    ticks = np.flatnonzero(trail.lane == number)
    passed = [trail.rows_passed[tick] for tick in ticks if in_phase(trail.states[tick], Phase.SIDESTEP)]
    return int(max(passed)) if passed else None


def _headland_m(bookings: Sequence[Booking], travel: Direction | None, robot: Robot | None) -> float | None:
    """Empty space used beyond the last crop, up to the camera that led."""
    beside = [booking for booking in bookings if in_phase(booking.state, Phase.SIDESTEP)]
    if robot is None or travel is None:
        return None
    used = [
        travel.sign * each.forward_m - each.lane_from_m - each.lane_length_m
        for each in beside
        if each.lane_from_m is not None and each.lane_length_m is not None
    ]
    return max(used) - robot.cameras.get(travel.leading).distance_m if used else None


def _mean(values: Floats) -> float:
    return float(values.mean()) if len(values) else nan


def _most(values: Floats) -> float:
    return float(values.max()) if len(values) else nan
