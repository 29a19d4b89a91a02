"""The state machine's diagram as one SVG that needs nothing else to be shown."""

from collections.abc import Iterator
from html import escape
from itertools import pairwise

from states.drawing.boxes import Box, column_of
from states.drawing.layout import Drawn, Layout, Point, lay_out
from states.names import Event, Top
from states.table import IDLE, LEAVES

INTERRUPTED = ("where it was", "interrupted")
BEND = 6.0
"""Radius of the arrows' corners."""
BASELINE, LINE = 4.5, 15.0
"""From a line of writing's middle to its foot; from one line to the next."""
START = 22.0
"""Length of the arrow that shows where the mission begins."""

PLAIN, STOP, PAUSE, RESET = "#37474f", "#b3261e", "#8a5a00", "#5e6b73"
COLOURS = {
    Event.FAIL: STOP,
    Event.LATCH: STOP,
    Event.PAUSE: PAUSE,
    Event.RESUME: PAUSE,
    Event.RESET: RESET,
}
FILLS = ("#e8f3ea", "#ffffff", "#e6eff8")
"""Of the composites of the left, middle and right column."""
STYLE = """
text { font: 13px 'DejaVu Sans', Verdana, Helvetica, Arial, sans-serif; fill: #20272b; }
.event { font-size: 12px; paint-order: stroke; stroke: #ffffff; stroke-width: 4px; stroke-linejoin: round; }
.name { font-weight: bold; }
.leaf { fill: #ffffff; stroke: #37474f; stroke-width: 1.4; }
.composite { stroke: #78909c; stroke-width: 1.2; }
.anywhere { fill: #fffbe9; stroke: #8a5a00; stroke-width: 1.2; stroke-dasharray: 4 3; }
.arrow { fill: none; stroke-width: 1.5; }
"""


def svg() -> str:
    """The whole table as a picture: composites around their states, an arrow for each transition."""
    layout = lay_out()
    parts = [*_frame(layout), *_boxes(layout), *_start(layout.boxes[IDLE])]
    parts += [_line(drawn) for drawn in layout.drawn] + [_event(drawn) for drawn in layout.drawn]
    return "\n".join([*parts, "</svg>"])


def _frame(layout: Layout) -> Iterator[str]:
    width, height = round(layout.width), round(layout.height)
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" role="img" aria-label="The mission\'s states and transitions">'
    )
    yield f"<style>{STYLE}</style>"
    yield "<defs>"
    for colour in dict.fromkeys([PLAIN, *COLOURS.values()]):
        yield (
            f'<marker id="{_marker(colour)}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" '
            f'markerHeight="7" orient="auto"><path d="M0 0L10 5L0 10z" fill="{colour}"/></marker>'
        )
    yield "</defs>"
    yield f'<rect width="{width}" height="{height}" fill="#ffffff"/>'


def _boxes(layout: Layout) -> Iterator[str]:
    composites = sorted((node for node in layout.boxes if node and node not in LEAVES), key=len)
    for node in composites:
        box = layout.boxes[node]
        fill = "#fbe9e7" if node[0] is Top.FAULT else FILLS[column_of(node)]
        yield _rectangle(box, "composite", f' fill="{fill}"' if len(node) == 1 else ' fill="#ffffff"')
        yield f'<text class="name" x="{box.left + 9:g}" y="{box.top + 16:g}">{escape(node[-1].value)}</text>'
    for leaf, box in layout.boxes.items():
        if leaf is None:
            yield _rectangle(box, "anywhere")
            yield from _centred(box, INTERRUPTED)
        elif leaf in LEAVES:
            yield _rectangle(box, "leaf")
            yield from _centred(box, (str(leaf[-1].value),))


def _rectangle(box: Box, kind: str, more: str = "") -> str:
    size = f'width="{box.right - box.left:g}" height="{box.height:g}"'
    return f'<rect class="{kind}" x="{box.left:g}" y="{box.top:g}" {size} rx="7"{more}/>'


def _centred(box: Box, lines: tuple[str, ...]) -> Iterator[str]:
    first = (box.top + box.bottom) / 2 - (len(lines) - 1) * LINE / 2 + BASELINE
    for index, line in enumerate(lines):
        place = f'x="{box.middle:g}" y="{first + index * LINE:g}"'
        yield f'<text text-anchor="middle" {place}>{escape(line)}</text>'


def _start(idle: Box) -> Iterator[str]:
    top = idle.top - START
    yield f'<circle cx="{idle.middle:g}" cy="{top:g}" r="6" fill="{PLAIN}"/>'
    yield _path([(idle.middle, top), (idle.middle, idle.top)], PLAIN)


def _line(drawn: Drawn) -> str:
    return _path(drawn.corners, COLOURS.get(drawn.arrow.event, PLAIN))


def _event(drawn: Drawn) -> str:
    colour = COLOURS.get(drawn.arrow.event, PLAIN)
    x, y = drawn.label
    place = f'x="{x:g}" y="{y:g}" text-anchor="{drawn.anchor}" style="fill:{colour}"'
    return f'<text class="event" {place}>{escape(drawn.arrow.event.value)}</text>'


def _path(corners: tuple[Point, ...] | list[Point], colour: str) -> str:
    """A line with rounded corners and an arrow's head."""
    first, *rest = corners
    steps = [f"M{first[0]:g} {first[1]:g}"]
    for (before, corner), (_, after) in pairwise(pairwise(corners)):
        near, far = _towards(corner, before), _towards(corner, after)
        steps.append(f"L{near[0]:g} {near[1]:g}Q{corner[0]:g} {corner[1]:g} {far[0]:g} {far[1]:g}")
    steps.append(f"L{rest[-1][0]:g} {rest[-1][1]:g}")
    return (
        f'<path class="arrow" d="{"".join(steps)}" stroke="{colour}" marker-end="url(#{_marker(colour)})"/>'
    )


def _towards(corner: Point, other: Point) -> Point:
    """Where the bend at a corner ends; the arrows' stretches are level or upright."""
    dx, dy = other[0] - corner[0], other[1] - corner[1]
    length = max(abs(dx), abs(dy), BEND)
    reach = min(BEND, length / 2) / length
    return corner[0] + dx * reach, corner[1] + dy * reach


def _marker(colour: str) -> str:
    return f"head-{colour.removeprefix('#')}"
