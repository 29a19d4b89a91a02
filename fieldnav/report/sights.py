"""What the states judged frame by frame, in columns."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import nan

import numpy as np

from fieldnav.inquiry.quantities import HEADING, LANE_ENDED, NEXT_LANE, OFFSET
from fieldnav.journal.entry import Judged
from fieldnav.messages import Floats
from fieldnav.recording.records import Stepped
from fieldnav.report.naming import follows_rows

PICKED = (OFFSET, HEADING, LANE_ENDED, NEXT_LANE)
COLUMNS = 11


@dataclass(frozen=True, slots=True)
class Sights:
    """One entry a judged step, arrays of shape (n,); what was not judged is nan.

    confidence: the mean of the rows', those kept from earlier frames count as 0; rows_seen of rows_sought
    are the ones with any. following: 1 while the robot drives along rows, else 0.
    """

    time_s: Floats
    lane: Floats
    following: Floats
    offset_m: Floats
    heading_deg: Floats
    lane_ended: Floats
    next_lane: Floats
    confidence: Floats
    rows_seen: Floats
    rows_sought: Floats
    plants: Floats

    def __len__(self) -> int:
        return len(self.time_s)


class SightColumns:
    """Takes in one step after the other."""

    def __init__(self) -> None:
        self._rows: list[tuple[float, ...]] = []

    def add(self, step: Stepped) -> None:
        """Take in a step; one without a frame tells nothing here."""
        if step.frame is None and not step.evidence:
            return
        confidences = [row.confidence for row in step.rows]
        sought = len(confidences)
        self._rows.append(
            (
                step.now_s,
                step.lane,
                follows_rows(step.state),
                *_picked(step.evidence),
                sum(confidences) / sought if sought else nan,
                sum(confidence > 0 for confidence in confidences) if sought else nan,
                sought or nan,
                nan if step.plants is None else step.plants,
            )
        )

    def sights(self) -> Sights:
        """The columns of all that was taken in."""
        return Sights(*np.array(self._rows, dtype=np.float64).reshape(-1, COLUMNS).T)


def sights_of(steps: Iterable[Stepped]) -> Sights:
    """The columns of the steps, in the order in which they come."""
    columns = SightColumns()
    for step in steps:
        columns.add(step)
    return columns.sights()


def _picked(evidence: Sequence[Judged]) -> list[float]:
    values = {judged.name: judged.value for judged in evidence}
    return [nan if (value := values.get(name)) is None else value for name in PICKED]
