"""The state machine's diagram as one SVG that needs nothing else to be shown."""

from collections.abc import Iterator
from html import escape

from states.drawing.boxes import Box, column_of
from states.drawing.layout import Drawn, Layout, lay_out
from states.drawing.strokes import INTERRUPTED, STYLE, centred, heads, path, rectangle
from states.names import Event, Top
from states.table import IDLE, LEAVES

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


def svg() -> str:
    """The whole table as a picture: composites around their states, an arrow for each transition."""
    layout = lay_out()
    parts = [*_frame(layout), *_boxes(layout), *start(layout.boxes[IDLE])]
    parts += [_line(drawn) for drawn in layout.drawn] + [_event(drawn) for drawn in layout.drawn]
    return "\n".join([*parts, "</svg>"])


def _frame(layout: Layout) -> Iterator[str]:
    width, height = round(layout.width), round(layout.height)
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" role="img" aria-label="The mission\'s states and transitions">'
    )
    yield f"<style>{STYLE}</style>"
    yield from heads([PLAIN, *COLOURS.values()])
    yield f'<rect width="{width}" height="{height}" fill="#ffffff"/>'


def _boxes(layout: Layout) -> Iterator[str]:
    composites = sorted((node for node in layout.boxes if node and node not in LEAVES), key=len)
    for node in composites:
        box = layout.boxes[node]
        fill = "#fbe9e7" if node[0] is Top.FAULT else FILLS[column_of(node)]
        yield rectangle(box, "composite", f' fill="{fill}"' if len(node) == 1 else ' fill="#ffffff"')
        yield f'<text class="name" x="{box.left + 9:g}" y="{box.top + 16:g}">{escape(node[-1].value)}</text>'
    for leaf, box in layout.boxes.items():
        if leaf is None:
            yield rectangle(box, "anywhere")
            yield from centred(box, INTERRUPTED)
        elif leaf in LEAVES:
            yield rectangle(box, "leaf")
            yield from centred(box, (str(leaf[-1].value),))


def start(idle: Box) -> Iterator[str]:
    """Where the mission begins."""
    top = idle.top - START
    yield f'<circle cx="{idle.middle:g}" cy="{top:g}" r="6" fill="{PLAIN}"/>'
    yield path([(idle.middle, top), (idle.middle, idle.top)], PLAIN)


def _line(drawn: Drawn) -> str:
    return path(drawn.corners, COLOURS.get(drawn.arrow.event, PLAIN))


def _event(drawn: Drawn) -> str:
    colour = COLOURS.get(drawn.arrow.event, PLAIN)
    x, y = drawn.label
    place = f'x="{x:g}" y="{y:g}" text-anchor="{drawn.anchor}" style="fill:{colour}"'
    return f'<text class="event" {place}>{escape(drawn.arrow.event.value)}</text>'
