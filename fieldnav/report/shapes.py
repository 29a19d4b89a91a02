"""What a chart is drawn from: places in the drawing, and what is written there."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Block:
    """One stay in a state, on the strip."""

    x: float
    width: float
    colour: str
    title: str


@dataclass(frozen=True, slots=True)
class Tick:
    """A labelled place on an axis."""

    at: float
    label: str


@dataclass(frozen=True, slots=True)
class Drawn:
    """A curve: its path, or its dots."""

    label: str
    colour: str
    path: str
    dots: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class DrawnPanel:
    """Curves over one vertical axis."""

    title: str
    top: float
    height: float
    ticks: tuple[Tick, ...]
    curves: tuple[Drawn, ...]


@dataclass(frozen=True, slots=True)
class Chart:
    """All that is drawn, in the units of the drawing; `stops`: places and numbers of the stops."""

    height: float
    blocks: tuple[Block, ...]
    lanes: tuple[Tick, ...]
    panels: tuple[DrawnPanel, ...]
    times: tuple[Tick, ...]
    stops: tuple[Tick, ...]
    strip_top: float
    strip_height: float
    width: float
    left: float
    right: float
