"""The diagram with a run painted in: where its time went, which ways it took, where it ended."""

from collections.abc import Iterator
from html import escape

from states.drawing.boxes import Box, Node
from states.drawing.layout import Drawn, Layout, lay_out
from states.drawing.legend import HEAD, heading, legend
from states.drawing.paint import DARK, TIMES, Paint, clock, shade, taken, width
from states.drawing.picture import COLOURS, PLAIN, start
from states.drawing.strokes import INTERRUPTED, STYLE, centred, heads, path, rectangle
from states.table import IDLE, LEAVES

PALE, PALE_INK, INK, LIGHT_INK = "#dde3e6", "#a3afb5", "#20272b", "#ffffff"
ARROWHEAD = 12.0
"""Of every arrow, however wide."""
MARK_WIDTH, MARK_HEIGHT, MARK_SIZE, INSET = 64.0, 14.0, 10.0, 5.0
"""Of the sign at the state in which the run ended, its writing, and its distance from the corner."""
EXTRA_STYLE = """.ground { fill: #f6f8f9; stroke: #b0bec5; stroke-width: 1.2; }
.ended { stroke: #20272b; stroke-width: 3; }
.time { font-size: 11px; }
"""


def painted(paint: Paint) -> str:
    """The whole table as a picture with a run in it; what never occurred is pale."""
    layout, times = lay_out(), paint.times()
    counted = sorted(((taken(drawn.arrow, times), drawn) for drawn in layout.drawn), key=lambda pair: pair[0])
    parts = [*_frame(layout, paint), *_composites(layout, paint), *_leaves(layout, paint, counted)]
    parts += [*start(layout.boxes[IDLE])]
    parts += [_line(drawn, count) for count, drawn in counted]
    parts += [_event(drawn, count) for count, drawn in counted]
    return "\n".join([*parts, *_ended(layout, paint), "</svg>"])


def _frame(layout: Layout, paint: Paint) -> Iterator[str]:
    wide, high = round(layout.width), round(layout.height + HEAD)
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 {-HEAD:g} {wide} {high}" width="{wide}" '
        f'height="{high}" role="img" aria-label="{escape(f"States and transitions of {paint.name}")}">'
    )
    yield f"<style>{STYLE}{EXTRA_STYLE}</style>"
    yield from heads([PALE, PLAIN, *COLOURS.values()], ARROWHEAD, ' markerUnits="userSpaceOnUse"')
    yield f'<rect y="{-HEAD:g}" width="{wide}" height="{high}" fill="#ffffff"/>'
    yield from heading(paint)
    yield from legend(wide)


def _composites(layout: Layout, paint: Paint) -> Iterator[str]:
    for node in sorted((node for node in layout.boxes if node and node not in LEAVES), key=len):
        box, visit = layout.boxes[node], paint.within(node)
        ink = INK if visit.entries else PALE_INK
        yield rectangle(box, "ground", "" if len(node) == 1 else ' style="fill:#ffffff"')
        place = f'y="{box.top + 16:g}" style="fill:{ink}"'
        yield f'<text class="name" x="{box.left + 9:g}" {place}>{escape(node[-1].value)}</text>'
        if visit.seconds:
            place = f'x="{box.right - 9:g}" {place} text-anchor="end"'
            yield f'<text class="time" {place}>{clock(visit.seconds)}</text>'


def _leaves(layout: Layout, paint: Paint, counted: list[tuple[int, Drawn]]) -> Iterator[str]:
    reached = {drawn.arrow.target for count, drawn in counted if count}
    for leaf, box in layout.boxes.items():
        if leaf is None:
            yield from _interrupted(box, None in reached)
        elif leaf in LEAVES:
            yield from _leaf(leaf, box, paint)


def _leaf(leaf: Node, box: Box, paint: Paint) -> Iterator[str]:
    assert leaf, "what was interrupted is drawn by itself"
    visit, depth = paint.within(leaf), paint.depth(leaf)
    if not visit.entries:
        yield rectangle(box, "leaf", f' style="stroke:{PALE}"')
        yield from centred(box, (str(leaf[-1].value),), f' style="fill:{PALE_INK}"')
        return
    spent = f"{clock(visit.seconds)} · " if visit.seconds else ""
    yield rectangle(box, "leaf", f' style="fill:{shade(depth)}"')
    ink = LIGHT_INK if depth > DARK else INK
    yield from centred(box, (str(leaf[-1].value), f"{spent}{visit.entries}{TIMES}"), f' style="fill:{ink}"')


def _interrupted(box: Box, reached: bool) -> Iterator[str]:
    yield rectangle(box, "anywhere", "" if reached else f' style="fill:#ffffff;stroke:{PALE}"')
    yield from centred(box, INTERRUPTED, "" if reached else f' style="fill:{PALE_INK}"')


def _line(drawn: Drawn, count: int) -> str:
    if not count:
        return path(drawn.corners, PALE)
    colour = COLOURS.get(drawn.arrow.event, PLAIN)
    return path(drawn.corners, colour, f' style="stroke-width:{width(count):.2g}"')


def _event(drawn: Drawn, count: int) -> str:
    colour = COLOURS.get(drawn.arrow.event, PLAIN) if count else PALE_INK
    x, y = drawn.label
    place = f'x="{x:g}" y="{y:g}" text-anchor="{drawn.anchor}" style="fill:{colour}"'
    written = f"{drawn.arrow.event.value} {TIMES}{count}" if count else drawn.arrow.event.value
    return f'<text class="event" {place}>{escape(written)}</text>'


def _ended(layout: Layout, paint: Paint) -> Iterator[str]:
    """The state in which the run ended: a heavy border, and a sign on it."""
    if paint.ended is None:
        return
    box = layout.boxes[paint.ended]
    yield rectangle(box, "ended", ' fill="none"')
    left, top = box.left + INSET, box.bottom - MARK_HEIGHT / 2
    size = f'width="{MARK_WIDTH:g}" height="{MARK_HEIGHT:g}" rx="{MARK_HEIGHT / 2:g}"'
    yield f'<rect x="{left:g}" y="{top:g}" {size} fill="{INK}"/>'
    place = f'x="{left + MARK_WIDTH / 2:g}" y="{top + MARK_SIZE + 1:g}" text-anchor="middle"'
    yield f'<text {place} style="fill:{LIGHT_INK};font-size:{MARK_SIZE:g}px">ended here</text>'
