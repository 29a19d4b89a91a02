"""`fieldnav log why --json`."""

from pathlib import Path
from typing import Any

from fieldnav.inquiry.asked import Asked
from fieldnav.inquiry.chances import Chance, chances
from fieldnav.inquiry.headline import Headline
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import DIGITS, Judged, Line


def as_json(
    directory: RunDirectory, asked: Asked, said: Headline, recorded: bool, picture: Path | None
) -> dict[str, Any]:
    """All that is said of a moment; lengths, angles and times in the units that stand beside them."""
    cause = said.cause
    return {
        "run": str(directory.path),
        "headline": said.text,
        "kind": said.kind.value,
        "at_s": asked.at_s,
        "lane": asked.line.lane,
        "state": asked.line.source if asked.happened else asked.line.target,
        "cause": cause.said,
        "fault": cause.fault and cause.fault.value,
        "advice": cause.advice,
        "seqs": [line.seq for line in cause.lines],
        "judged": [_judged(each) for each in said.evidence],
        "events": [_chance(each) for each in chances(said.evidence)],
        "line": _line(asked.line),
        "before": _line(asked.before[-1]) if asked.before else None,
        "after": _line(asked.after),
        "recorded": recorded,
        "picture": picture and str(picture),
    }


def _judged(judged: Judged) -> dict[str, Any]:
    return judged.model_dump(mode="json") | {"margin": _margin(judged), "holds": judged.holds}


def _margin(judged: Judged) -> float | None:
    return None if judged.margin is None else round(judged.margin, DIGITS) + 0.0


def _chance(chance: Chance) -> dict[str, Any]:
    return {
        "event": chance.event,
        "holds": chance.holds,
        "decided_by": [each.name for each in chance.deciding],
        "margins": [_margin(each) for each in chance.deciding],
    }


def _line(line: Line | None) -> dict[str, Any] | None:
    return None if line is None else line.model_dump(mode="json")
