"""A chart of several panels over one time axis, as the numbers that the page's SVG is drawn from."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fieldnav.inquiry.moment import clock
from fieldnav.journal.phases import PHASE_COLOURS
from fieldnav.report.curves import Curve, Panel, panel_range
from fieldnav.report.scale import clock_steps, minutes, round_steps, thinned
from fieldnav.report.shapes import Block, Chart, Drawn, DrawnPanel, Tick
from fieldnav.report.spans import Span
from fieldnav.report.words import fixed

WIDTH, GUTTER, RIGHT = 1000.0, 62.0, 22.0
"""Of the drawing, of what lies left of the time axis, and right of it, in the drawing's units."""
STRIP_TOP, STRIP_HEIGHT = 22.0, 26.0
PANEL_HEIGHT, APART, TITLE, FOOT = 84.0, 12.0, 22.0, 26.0
MOST_TIMES, MOST_VALUES, MOST_POINTS = 12, 4, 450


def chart_of(
    panels: Sequence[Panel], spans: Sequence[Span], stops_s: Sequence[tuple[float, str]], end_s: float
) -> Chart:
    """Lay a chart out. stops_s: time and label of each mark."""
    begin_s = min((span.from_s for span in spans), default=0.0)
    time = Scale(begin_s, max(end_s, begin_s + 1.0), GUTTER, WIDTH - RIGHT)
    top, drawn = STRIP_TOP + STRIP_HEIGHT + APART if spans else 0.0, []
    for panel in panels:
        drawn.append(_panel(panel, time, top + TITLE))
        top += TITLE + PANEL_HEIGHT + APART
    return Chart(
        height=top + FOOT,
        blocks=tuple(_block(span, time) for span in spans if span.seconds > 0),
        lanes=_lanes(spans, time),
        panels=tuple(drawn),
        times=tuple(Tick(time(at), minutes(at)) for at in clock_steps(time.low, time.high, MOST_TIMES)),
        stops=tuple(Tick(time(at), label) for at, label in stops_s),
        strip_top=STRIP_TOP if spans else TITLE,
        strip_height=STRIP_HEIGHT,
        width=WIDTH,
        left=GUTTER,
        right=WIDTH - RIGHT,
    )


@dataclass(frozen=True, slots=True)
class Scale:
    """Maps a quantity's range onto a stretch of the drawing, to a tenth of its units."""

    low: float
    high: float
    first: float
    last: float

    def __call__(self, value: float) -> float:
        return round(self.first + (value - self.low) / (self.high - self.low) * (self.last - self.first), 1)


def _block(span: Span, time: Scale) -> Block:
    title = f"{span.state}, {clock(span.from_s)} to {clock(span.to_s)}"
    return Block(
        time(span.from_s), round(time(span.to_s) - time(span.from_s), 1), PHASE_COLOURS[span.phase], title
    )


def _lanes(spans: Sequence[Span], time: Scale) -> tuple[Tick, ...]:
    """Where each lane begins."""
    first: dict[int, float] = {}
    for span in spans:
        if span.lane is not None:
            first.setdefault(span.lane, span.from_s)
    return tuple(Tick(time(from_s), f"lane {lane}") for lane, from_s in first.items())


def _panel(panel: Panel, time: Scale, top: float) -> DrawnPanel:
    low, high = panel_range(panel)
    values = Scale(low, high, top + PANEL_HEIGHT, top)
    steps = round_steps(low, high, MOST_VALUES)
    decimals = max((len(str(step).partition(".")[2].rstrip("0")) for step in steps), default=0)
    return DrawnPanel(
        panel.title,
        top,
        PANEL_HEIGHT,
        tuple(Tick(values(step), fixed(step, decimals)) for step in steps),
        tuple(_curve(curve, time, values) for curve in panel.curves),
    )


def _curve(curve: Curve, time: Scale, values: Scale) -> Drawn:
    kept = thinned(curve.time_s, curve.values, MOST_POINTS)
    at_s, shown = curve.time_s[kept], curve.values[kept]
    places = [(time(float(t)), values(float(v))) for t, v in zip(at_s, shown, strict=True) if np.isfinite(v)]
    if curve.dotted:
        return Drawn(curve.label, curve.colour, "", tuple(places))
    finite = np.isfinite(shown)
    begins = np.concatenate([np.ones(len(shown[:1]), bool), ~finite[:-1]])[finite]
    steps = (f"{'M' if new else 'L'}{x:g} {y:g}" for (x, y), new in zip(places, begins, strict=True))
    return Drawn(curve.label, curve.colour, "".join(steps), ())
