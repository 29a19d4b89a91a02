"""Where the states' boxes stand: a column for each direction of travel, the other states between them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fieldnav.messages import Direction
from states.names import Path
from states.table import LEAVES, PAUSED

Node = Path | None
"""A state; None stands for wherever the mission was interrupted."""

WIDTH, PADDING, TITLE = 148.0, 14.0, 24.0
"""Of a leaf's box; between a composite's border and what is in it; height of a composite's name."""
GAP = 40.0
"""Between leaves one above the other: room for an arrow and its event."""
PORT = 20.0
"""Between arrows at the same side of a box: a line of writing."""
LEAST_HEIGHT = 38.0
TOP = 60.0
LAST_COLUMN = 2


@dataclass(frozen=True, slots=True)
class Box:
    """A state's box, in the picture's units, y down."""

    left: float
    top: float
    right: float
    bottom: float

    @property
    def middle(self) -> float:
        return (self.left + self.right) / 2

    @property
    def height(self) -> float:
        return self.bottom - self.top


def column_of(node: Node) -> int:
    """0 for the states of driving forward, 2 for backward, 1 for the others."""
    if node is None or not isinstance(node[0], Direction):
        return 1
    return 0 if node[0] is Direction.FORWARD else LAST_COLUMN


def nodes_of(column: int) -> list[Node]:
    """The leaves of a column from top to bottom, in the table's order."""
    nodes: list[Node] = [leaf for leaf in LEAVES if column_of(leaf) == column]
    if PAUSED in nodes:
        nodes.insert(nodes.index(PAUSED) + 1, None)
    return nodes


def composites_of(nodes: Sequence[Node]) -> list[Path]:
    """The composites around some leaves, the outer before the inner."""
    found = dict.fromkeys(node[:depth] for node in nodes if node for depth in range(1, len(node)))
    return sorted(found, key=len)


def stack(
    nodes: Sequence[Node], middle: float, ports: Mapping[Node, int], height: float = 0.0
) -> dict[Node, Box]:
    """Boxes of a column's leaves and composites one below the other; gaps widen to fill `height`."""
    boxes = _stacked(nodes, middle, ports, GAP)
    short = height - (max(box.bottom for box in boxes.values()) - TOP)
    if short > 0:
        boxes = _stacked(nodes, middle, ports, GAP + short / (len(nodes) - 1))
    return boxes


def _stacked(nodes: Sequence[Node], middle: float, ports: Mapping[Node, int], gap: float) -> dict[Node, Box]:
    boxes: dict[Node, Box] = {}
    y, open_before = TOP, set[Path]()
    for node in nodes:
        around = set(composites_of([node]))
        y += len(open_before - around) * PADDING + len(around - open_before) * TITLE
        height = max(LEAST_HEIGHT, (ports.get(node, 0) + 1) * PORT)
        boxes[node] = Box(middle - WIDTH / 2, y, middle + WIDTH / 2, y + height)
        y, open_before = y + height + gap, around
    for path in reversed(composites_of(nodes)):
        inside = [box for node, box in boxes.items() if node and node != path and node[: len(path)] == path]
        boxes[path] = Box(
            min(box.left for box in inside) - PADDING,
            min(box.top for box in inside) - TITLE,
            max(box.right for box in inside) + PADDING,
            max(box.bottom for box in inside) + PADDING,
        )
    return boxes
