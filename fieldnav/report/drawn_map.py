"""The map of a run: the one that lies in its directory, else the way by dead reckoning."""

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from fieldnav.journal.map import RunMap, draw_map
from fieldnav.messages import Floats
from fieldnav.report.embedded import map_uri
from fieldnav.report.material import Material
from fieldnav.report.trail import Trail
from states.names import Phase

APART_M = 0.02
"""Of the points of the way that are drawn."""


@dataclass(frozen=True, slots=True)
class ReportMap:
    """The picture as data inside the page, and what it shows."""

    uri: str
    caption: str


def map_of(material: Material) -> ReportMap | None:
    """The map; None when nothing tells where the robot was."""
    kept = map_uri(material.directory.map)
    if kept:
        return ReportMap(kept, "The way as it was truly driven, the crop rows as they were sown.")
    if len(material.trail) <= 1:
        return None
    with TemporaryDirectory(prefix="fieldnav-report-") as folder:
        path = Path(folder) / "map.png"
        draw_map(path, reckoned(material.trail))
        return ReportMap(map_uri(path), "The way by dead reckoning from the wheels: it drifts.")


def reckoned(trail: Trail) -> RunMap:
    """The way that the wheels tell, with row ends as judged and rows as counted."""
    way = np.stack([trail.x_m, trail.y_m], axis=1)
    entered = trail.within(Phase.EXIT)
    ends = np.flatnonzero(entered[1:] & ~entered[:-1]) + 1
    counted = np.flatnonzero(np.diff(trail.rows_passed) > 0) + 1
    kept = _apart(way, trail.states)
    return RunMap(
        path_m=way[kept],
        states=[trail.states[index] for index in kept],
        row_ends_m=way[ends],
        crossings_m=way[counted],
        title="The way by dead reckoning",
    )


def _apart(way: Floats, states: tuple[str, ...]) -> list[int]:
    """Points that lie some way apart, and those at which the state changes."""
    kept = [0]
    for index in range(1, len(way)):
        moved = np.abs(way[index] - way[kept[-1]]).max() > APART_M
        if moved or states[index] != states[index - 1]:
            kept.append(index)
    return kept if kept[-1] == len(way) - 1 else [*kept, len(way) - 1]
