"""The ticks of a recording in columns."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import nan

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats
from fieldnav.recording.records import Ticked
from fieldnav.report.naming import in_phase
from states.names import Phase

COLUMNS = 9


@dataclass(frozen=True, slots=True)
class Trail:
    """One entry a tick, arrays of shape (n,); what was not known is nan.

    speed_mps: as commanded, 0 while the wheels only turn; battery_v the lowest of the modules',
    temperature_c the hottest.
    """

    states: tuple[str, ...]
    time_s: Floats
    lane: Floats
    x_m: Floats
    y_m: Floats
    speed_mps: Floats
    rows_passed: Floats
    charge_percent: Floats
    battery_v: Floats
    temperature_c: Floats

    def __len__(self) -> int:
        return len(self.time_s)

    def within(self, phase: Phase) -> NDArray[np.bool_]:
        """Which of the ticks belong to a phase, shape (n,)."""
        phases = {state: in_phase(state, phase) for state in set(self.states)}
        return np.array([phases[state] for state in self.states], dtype=np.bool_)


def trail_of(ticks: Iterable[Ticked]) -> Trail:
    """The columns of the ticks, in the order in which they come."""
    rows, states = [], []
    for tick in ticks:
        rows.append(_row(tick))
        states.append(tick.state)
    table = np.array(rows, dtype=np.float64).reshape(-1, COLUMNS)
    return Trail(tuple(states), *table.T)


def _row(tick: Ticked) -> tuple[float, ...]:
    modules = tick.modules.values()
    return (
        tick.now_s,
        tick.lane,
        tick.x_m,
        tick.y_m,
        tick.told_mps,
        tick.rows_passed,
        nan if tick.charge_percent is None else tick.charge_percent,
        min((each.battery_v for each in modules if each.battery_v), default=nan),
        max((each.temperature_c for each in modules if each.temperature_c is not None), default=nan),
    )
