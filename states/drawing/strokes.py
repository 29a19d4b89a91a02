"""The strokes of the picture as SVG: boxes, writing in them, arrows with rounded corners."""

from collections.abc import Iterable, Iterator
from html import escape
from itertools import pairwise

from states.drawing.boxes import Box
from states.drawing.layout import Point

BEND = 6.0
"""Radius of the arrows' corners."""
BASELINE, LINE = 4.5, 15.0
"""From a line of writing's middle to its foot; from one line to the next."""
INTERRUPTED = ("where it was", "interrupted")

STYLE = """
text { font: 13px 'DejaVu Sans', Verdana, Helvetica, Arial, sans-serif; fill: #20272b; }
.event { font-size: 12px; paint-order: stroke; stroke: #ffffff; stroke-width: 4px; stroke-linejoin: round; }
.name { font-weight: bold; }
.leaf { fill: #ffffff; stroke: #37474f; stroke-width: 1.4; }
.composite { stroke: #78909c; stroke-width: 1.2; }
.anywhere { fill: #fffbe9; stroke: #8a5a00; stroke-width: 1.2; stroke-dasharray: 4 3; }
.arrow { fill: none; stroke-width: 1.5; }
"""


def rectangle(box: Box, kind: str, more: str = "") -> str:
    """A state's box; more: further attributes, with a space before each."""
    size = f'width="{box.right - box.left:g}" height="{box.height:g}"'
    return f'<rect class="{kind}" x="{box.left:g}" y="{box.top:g}" {size} rx="7"{more}/>'


def centred(box: Box, lines: tuple[str, ...], more: str = "") -> Iterator[str]:
    """Lines of writing in the middle of a box."""
    first = (box.top + box.bottom) / 2 - (len(lines) - 1) * LINE / 2 + BASELINE
    for index, line in enumerate(lines):
        place = f'x="{box.middle:g}" y="{first + index * LINE:g}"'
        yield f'<text text-anchor="middle" {place}{more}>{escape(line)}</text>'


def heads(colours: Iterable[str], size: float = 7, units: str = "") -> Iterator[str]:
    """The arrows' heads, one in each colour."""
    yield "<defs>"
    for colour in dict.fromkeys(colours):
        measure = f'markerWidth="{size:g}" markerHeight="{size:g}"{units} orient="auto"'
        yield (
            f'<marker id="{_marker(colour)}" viewBox="0 0 10 10" refX="9" refY="5" {measure}>'
            f'<path d="M0 0L10 5L0 10z" fill="{colour}"/></marker>'
        )
    yield "</defs>"


def path(corners: tuple[Point, ...] | list[Point], colour: str, more: str = "") -> str:
    """A line with rounded corners and an arrow's head, whose colour is among the heads."""
    first, *rest = corners
    steps = [f"M{first[0]:g} {first[1]:g}"]
    for (before, corner), (_, after) in pairwise(pairwise(corners)):
        near, far = _towards(corner, before), _towards(corner, after)
        steps.append(f"L{near[0]:g} {near[1]:g}Q{corner[0]:g} {corner[1]:g} {far[0]:g} {far[1]:g}")
    steps.append(f"L{rest[-1][0]:g} {rest[-1][1]:g}")
    head = f'marker-end="url(#{_marker(colour)})"'
    return f'<path class="arrow" d="{"".join(steps)}" stroke="{colour}" {head}{more}/>'


def _towards(corner: Point, other: Point) -> Point:
    """Where the bend at a corner ends; the arrows' stretches are level or upright."""
    dx, dy = other[0] - corner[0], other[1] - corner[1]
    length = max(abs(dx), abs(dy), BEND)
    reach = min(BEND, length / 2) / length
    return corner[0] + dx * reach, corner[1] + dy * reach


def _marker(colour: str) -> str:
    return f"head-{colour.removeprefix('#')}"
