"""What a foreign replay came to, for a person and for a program."""

import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from rich.console import Group, RenderableType
from rich.text import Text

from fieldnav.cli.console import PLAIN_WIDTH, out
from fieldnav.cli.log.tables import transitions_table
from fieldnav.inquiry.moment import clock
from fieldnav.journal.journal import read
from fieldnav.journal.summary import to_json
from fieldnav.replay.foreign.ground_speed import as_assumed
from fieldnav.settings.one_line import one_line

if TYPE_CHECKING:
    from fieldnav.replay.foreign.drive import Driven
    from fieldnav.replay.foreign.order import Order
    from fieldnav.replay.foreign.sightings import Seen

CM = 100
PER_CENT = 100
AS_GOOD_AS_NONE = 0.1
"""Of the assumed speed: the robot stood, or drove aside or the other way."""


def report(order: "Order", driven: "Driven") -> RenderableType:
    """The transitions in a table, above them what was assumed, below them how well rows were seen."""
    frames = ", ".join(
        f"{camera.frames} of {camera.counts.total} {name.value}" for name, camera in order.cameras.items()
    )
    head = f"{order.name}: {clock(driven.summary.duration_s)} replayed, frames: {frames}"
    notes = [Text(one_line(said), style="yellow") for said in _notes(order, driven)]
    return Group(
        Text(one_line(head)),
        Text(_assumed(order)),
        *notes,
        transitions_table(read(driven.directory.journal), min(out().width, PLAIN_WIDTH)),
        Text(_sighted(driven.seen)),
    )


def document(order: "Order", driven: "Driven") -> dict[str, Any]:
    """The same for a program."""
    return {
        "run": str(driven.directory.path),
        "source": order.name,
        "frames": {name.value: camera.frames for name, camera in order.cameras.items()},
        "pictures": {
            name.value: asdict(camera.counts) | {"not_looked_at": camera.counts.not_looked_at}
            for name, camera in order.cameras.items()
        },
        "notes": _notes(order, driven),
        "ground_share": driven.ground_share,
        "seen": driven.seen.model_dump() | {"share": driven.seen.share},
        "transitions": [line.model_dump(mode="json") for line in read(driven.directory.journal)],
        "summary": json.loads(to_json(driven.summary)),
    }


def _notes(order: "Order", driven: "Driven") -> list[str]:
    """What a person should know, once each."""
    share, speed_mps = driven.ground_share, order.options["speed_mps"]
    said = [*driven.said, *dict.fromkeys(driven.summary.warnings)]
    if share is None or as_assumed(share):
        return said
    moves = f"by the pictures the ground moves at {share:.2f} times the speed"
    if not isinstance(speed_mps, float):
        return [*said, f"{moves} that the odometry tells"]
    if share <= AS_GOOD_AS_NONE:
        return [*said, f"{moves} that is assumed: it does not move {order.options['direction']}"]
    return [*said, f"{moves} that is assumed; --speed {share * speed_mps:.2f} would fit"]


def _assumed(order: "Order") -> str:
    """What nobody has recorded."""
    speed_mps, way = order.options["speed_mps"], order.options["direction"]
    if speed_mps is None:
        moved = f"motion by {order.options['odometry']}, lane driven {way}"
    else:
        moved = f"assumed: {way} at {speed_mps:g} m/s along the lane"
    return f"{moved}; the recorded robot did not do what it is told here"


def _sighted(seen: "Seen") -> str:
    if not seen.frames:
        return "no frame was looked at for rows"
    counted = f"rows seen in {seen.with_rows} of {seen.frames} frames ({seen.share * PER_CENT:.0f} %)"
    if seen.offset_m is None or seen.offset_sd_m is None:
        return counted
    offset = f"offset {seen.offset_m * CM:+.1f} +- {seen.offset_sd_m * CM:.1f} cm"
    return f"{counted}, {offset}, heading {seen.heading_deg:+.1f} +- {seen.heading_sd_deg:.1f} deg"
