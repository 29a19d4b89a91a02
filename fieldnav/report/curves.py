"""What is drawn over time: curves from the recording, or from the journal where there is none."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import hypot

import numpy as np

from fieldnav.journal.entry import Line
from fieldnav.journal.phases import PHASE_COLOURS
from fieldnav.messages import Floats
from fieldnav.recording.records import Stepped
from fieldnav.report.material import Material
from fieldnav.report.scale import range_of
from fieldnav.report.sights import sights_of
from states.names import Phase

CM_A_METRE = 100
SHOWN_CM, SHOWN_DEG, SHOWN_MPS = (-2.0, 2.0), (-1.0, 1.0), (0.0, 0.5)
"""So that what is next to nothing looks like it. Our choice."""
LONGEST_GAP_S = 1.0
"""Not every frame is judged for everything: values that lie closer belong together."""
SHOWN_PERCENT = (0.0, 100.0)
MAIN, ENDING, NEXT = (PHASE_COLOURS[phase.value] for phase in (Phase.FOLLOW, Phase.EXIT, Phase.SIDESTEP))
"""Colours: what is seen, what speaks for the lane's end, what speaks for the next lane's place."""


@dataclass(frozen=True, slots=True)
class Curve:
    """Values over time, arrays of shape (n,); nan breaks the line. dotted: single values, nothing between."""

    label: str
    colour: str
    time_s: Floats
    values: Floats
    dotted: bool = False


@dataclass(frozen=True, slots=True)
class Panel:
    """Curves over one vertical axis, on which at least the values of `shown` have room."""

    title: str
    curves: tuple[Curve, ...]
    shown: tuple[float, ...] = ()


def driving_panels(material: Material) -> list[Panel]:
    """How it drove: offset, heading, confidence, speed, rows counted; without what nothing is known of."""
    sights = material.sights if material.recorded else sights_of(_judged(material.lines))
    trail, dotted = material.trail, not material.recorded

    def seen(label: str, colour: str, values: Floats) -> Curve:
        return Curve(label, colour, *joined(sights.time_s, values), dotted)

    speed = Curve("commanded", MAIN, trail.time_s, trail.speed_mps) if len(trail) else _speed(material.lines)
    sure = (
        seen("of the rows", MAIN, sights.confidence),
        seen("that the lane has ended", ENDING, sights.lane_ended),
        seen("of the next lane's place", NEXT, sights.next_lane),
    )
    panels = [
        Panel("offset, cm", (seen("from the lane", MAIN, sights.offset_m * CM_A_METRE),), SHOWN_CM),
        Panel("heading, deg", (seen("against the lane", MAIN, sights.heading_deg),), SHOWN_DEG),
        Panel("confidence", sure, (0.0, 1.0)),
        Panel("speed, m/s", (speed,), SHOWN_MPS),
        Panel("rows counted", (Curve("in the sidestep", NEXT, trail.time_s, trail.rows_passed),)),
    ]
    return _with_values(panels)


def joined(time_s: Floats, values: Floats) -> tuple[Floats, Floats]:
    """Times and values of what is known; a nan stands where two of them lie too far apart to be joined."""
    known = np.isfinite(values)
    time_s, values = time_s[known], values[known]
    gaps = np.flatnonzero(np.diff(time_s) > LONGEST_GAP_S) + 1
    return np.insert(time_s, gaps, time_s[gaps - 1]), np.insert(values, gaps, np.nan)


def panel_range(panel: Panel) -> tuple[float, float]:
    """From where to where its axis goes."""
    return range_of([*(curve.values for curve in panel.curves), np.array(panel.shown, float)])


def health_panels(material: Material) -> list[Panel]:
    """How the robot fared: charge, voltage, temperature."""
    trail = material.trail
    panels = [
        Panel(
            "charge, %", (Curve("of the battery", MAIN, trail.time_s, trail.charge_percent),), SHOWN_PERCENT
        ),
        Panel("voltage, V", (Curve("lowest of the modules", MAIN, trail.time_s, trail.battery_v),)),
        Panel("temperature, °C", (Curve("hottest module", ENDING, trail.time_s, trail.temperature_c),)),
    ]
    return _with_values(panels)


def _judged(lines: Iterable[Line]) -> Iterable[Stepped]:
    for line in lines:
        if line.evidence:
            yield Stepped(
                now_s=line.stamp_s,
                state=line.source,
                lane=line.lane or 0,
                forward_m=line.forward_m or 0.0,
                evidence=line.evidence,
            )


def _speed(lines: Iterable[Line]) -> Curve:
    """The commands that the journal's lines name."""
    told = [(line.stamp_s, line.command) for line in lines if line.command is not None]
    values = [hypot(each.get("vx_mps") or 0.0, each.get("vy_mps") or 0.0) for _, each in told]
    times = [stamp_s for stamp_s, _ in told]
    return Curve("commanded", MAIN, np.array(times, float), np.array(values, float), dotted=True)


def _with_values(panels: Iterable[Panel]) -> list[Panel]:
    """Those of which something is known, with the curves of which something is."""
    kept = []
    for panel in panels:
        curves = tuple(curve for curve in panel.curves if np.isfinite(curve.values).any())
        if curves:
            kept.append(Panel(panel.title, curves, panel.shown))
    return kept
