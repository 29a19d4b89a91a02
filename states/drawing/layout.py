"""The whole picture: columns, the spaces between them, tracks in the spaces, places at the boxes' sides."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import accumulate

from states.drawing.arrows import Arrow, Track, Way, arrows
from states.drawing.boxes import LAST_COLUMN, PADDING, WIDTH, Box, Node, column_of, nodes_of, stack
from states.drawing.places import Places, tracks_of

TRACK = 14.0
"""Between neighbouring tracks."""
COLUMN = WIDTH + 4 * PADDING
"""Width of a column with two composites about its leaves."""
LANE_ROOM, MIDDLE_ROOM = 108.0, 26.0
"""Room for the events' names beside the columns of the lanes and beside the middle one."""
MARGIN, BUS = 20.0, 24.0
LABEL_GAP = 5.0

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Drawn:
    """An arrow as it is drawn: its corners, and where its event is written; anchor as SVG has it."""

    arrow: Arrow
    corners: tuple[Point, ...]
    label: Point
    anchor: str


@dataclass(frozen=True, slots=True)
class Layout:
    """Everything in its place."""

    boxes: Mapping[Node, Box]
    drawn: tuple[Drawn, ...]
    width: float
    height: float


def lay_out() -> Layout:
    """The picture of the whole table."""
    everything = arrows()
    places = Places(everything)
    tracks = [tracks_of(everything, gutter) for gutter in range(LAST_COLUMN + 2)]
    rooms = (LANE_ROOM, LANE_ROOM + MIDDLE_ROOM, LANE_ROOM + MIDDLE_ROOM, LANE_ROOM)
    widths = [room + len(inside) * TRACK for room, inside in zip(rooms, tracks, strict=True)]
    lefts = list(accumulate((width + COLUMN for width in widths[1:-1]), initial=MARGIN + widths[0]))
    boxes: dict[Node, Box] = {}
    for column in (0, LAST_COLUMN, 1):
        lowest = max((box.bottom for box in boxes.values()), default=0.0)
        middle = lefts[column] + COLUMN / 2
        boxes |= stack(nodes_of(column), middle, places.counts, lowest if column == 1 else 0.0)
    lowest = max(box.bottom for box in boxes.values())
    track_x: dict[Track, float] = {}
    for gutter, inside in enumerate(tracks):
        # Tracks lie in the order of their length, the shortest nearest the column that they belong to.
        owner, outward = ((0, -1), (1, -1), (1, 1), (LAST_COLUMN, 1))[gutter]
        room = LANE_ROOM if gutter in (0, LAST_COLUMN + 1) else MIDDLE_ROOM
        edge = lefts[owner] + (COLUMN if outward > 0 else 0.0)
        for index, track in enumerate(inside):
            track_x[track] = edge + outward * (room + index * TRACK)
    around = [arrow for arrow in everything if arrow.way is Way.AROUND]
    bus_y = {arrow: lowest + BUS * (1 + index) for index, arrow in enumerate(around)}
    router = _Router(boxes, places, track_x, bus_y, lefts)
    return Layout(
        boxes,
        tuple(router.draw(arrow) for arrow in everything),
        lefts[-1] + COLUMN + widths[-1] + MARGIN,
        lowest + BUS * (len(around) + 1),
    )


class _Router:
    """Gives each arrow its corners."""

    def __init__(
        self,
        boxes: Mapping[Node, Box],
        places: Places,
        track_x: Mapping[Track, float],
        bus_y: Mapping[Arrow, float],
        lefts: list[float],
    ) -> None:
        self._boxes, self._places, self._track_x = boxes, places, track_x
        self._bus_y, self._lefts = bus_y, lefts

    def draw(self, arrow: Arrow) -> Drawn:
        source, target = self._boxes[arrow.source], self._boxes[arrow.target]
        if arrow.way is Way.DOWN:
            x, label_y = source.middle, (source.bottom + target.top) / 2 + LABEL_GAP
            return Drawn(arrow, ((x, source.bottom), (x, target.top)), (x + LABEL_GAP, label_y), "start")
        end_x = target.left if arrow.enters_left else target.right
        end = (end_x, target.top + target.height * self._places.arrival(arrow))
        if arrow.way is Way.LEVEL:
            start = (source.left if arrow.leaves_left else source.right, end[1])
            return self._labelled(arrow, (start, end))
        track_x = self._track_x[arrow.track]
        if arrow.way is Way.AROUND:
            bus_y, x = self._bus_y[arrow], source.middle
            corners = ((x, source.bottom), (x, bus_y), (track_x, bus_y), (track_x, end[1]), end)
            outward = 1 if track_x > x else -1
            return Drawn(
                arrow,
                corners,
                (x + outward * LABEL_GAP * 2, bus_y - LABEL_GAP),
                "start" if outward > 0 else "end",
            )
        start_x = source.left if arrow.leaves_left else source.right
        start = (start_x, source.top + source.height * self._places.departure(arrow))
        return self._labelled(arrow, (start, (track_x, start[1]), (track_x, end[1]), end))

    def _labelled(self, arrow: Arrow, corners: tuple[Point, ...]) -> Drawn:
        """The event is written over the arrow's first stretch, beyond the composites' borders."""
        column = column_of(arrow.source)
        x = corners[0][0]
        if column != 1:
            x = self._lefts[column] + (0.0 if arrow.leaves_left else COLUMN)
        x += -LABEL_GAP if arrow.leaves_left else LABEL_GAP
        return Drawn(arrow, corners, (x, corners[0][1] - LABEL_GAP), "end" if arrow.leaves_left else "start")
