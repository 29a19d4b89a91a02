"""`fieldnav log stats --json`."""

from collections.abc import Sequence
from dataclasses import asdict
from statistics import median
from typing import Any

from fieldnav.cli.log.near_misses import Missed
from fieldnav.inquiry.outcome import Overview
from fieldnav.inquiry.spent import Account
from fieldnav.inquiry.tally import Tally


def as_json(ended: Overview, spent: Account, made: Tally, missed: Missed) -> dict[str, Any]:
    """Everything that is added up; margins in the units beside them."""
    return {
        "run": ended.run,
        "outcome": ended.outcome.value,
        "states": {state: asdict(in_it) for state, in_it in spent.states.items()},
        "transitions": [
            {"source": source, "event": event, "target": target, "times": times}
            for (source, event, target), times in spent.made.items()
        ],
        "lanes": {str(lane): asdict(each) for lane, each in sorted(made.lanes.items())},
        "margins": [
            {"event": event, "condition": name, "unit": unit, **_spread(margins)}
            for (event, name, unit), margins in sorted(made.margins.items())
        ],
        "stops": dict(made.faults),
        "holds": dict(made.holds),
        "near_misses": [
            {
                "at_s": miss.step.now_s,
                "lane": miss.step.lane,
                "state": miss.step.state,
                "event": miss.chance.event,
                "lacking_share": miss.lacking,
                "by": [each.name for each in miss.chance.deciding],
            }
            for miss in missed.misses
        ],
        "loop": ended.summary.loop.model_dump() if ended.summary and ended.summary.loop else None,
    }


def _spread(margins: Sequence[float]) -> dict[str, float]:
    spread = {"least": min(margins), "median": median(margins), "most": max(margins)}
    return {"times": len(margins)} | spread
