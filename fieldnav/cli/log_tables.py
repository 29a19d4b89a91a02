"""The tables of `fieldnav log`."""

from collections.abc import Sequence
from math import isfinite

from rich.table import Table
from rich.text import Text

from fieldnav.cli.console import table
from fieldnav.journal.entry import Judged, Line
from fieldnav.journal.outcome import Outcome, Overview

COLOURS = {
    Outcome.FINISHED: "green",
    Outcome.STOPPED: "red",
    Outcome.BROKEN_OFF: "yellow",
    Outcome.UNREADABLE: "yellow",
}
SECONDS_A_MINUTE = 60


def runs_table(title: str, overviews: Sequence[Overview]) -> Table:
    """One line a run."""
    columns = ("run", "outcome", "lanes", "switches", "distance", "time", "ended in")
    rows = [(each.run, _outcome(each), *_figures(each), _ending(each)) for each in overviews]
    return table(f"runs in {title}", columns, rows, right=("lanes", "switches", "distance", "time"))


def heading(each: Overview) -> Text:
    """How one run ended, above its transitions."""
    lanes, switches, distance, time = _figures(each)
    figures = (
        f"lanes {lanes}, switches {switches}, {distance} in {time}" if each.summary else f"{time} recorded"
    )
    return Text.assemble((each.run, "bold"), "  ", _outcome(each), f"  {figures}", "\n", _ending(each), "\n")


def transitions_table(lines: Sequence[Line]) -> Table:
    """One line a transition: its reason, then what was judged."""
    columns = ("time", "from", "to", "event", "lane", "rows", "because")
    rows = [
        (
            _clock(line.stamp_s),
            line.source,
            line.target,
            line.event,
            "" if line.lane is None else str(line.lane),
            "" if line.rows is None else str(line.rows),
            _because(line),
        )
        for line in lines
    ]
    return table("", columns, rows, right=("time", "lane", "rows"))


def _because(line: Line) -> Text:
    """The reason, which stands out where there is one, above the deciding quantities."""
    reason = [Text(line.reason, style="bold")] if line.reason else []
    return Text("\n").join([*reason, *(Text(judgement(judged)) for judged in decisive(line.evidence))])


def decisive(evidence: Sequence[Judged]) -> list[Judged]:
    """The quantities held against a threshold; all of them when none was."""
    return [judged for judged in evidence if judged.threshold is not None] or list(evidence)


def judgement(judged: Judged) -> str:
    """A quantity as a person reads it: its value, which way it lies from its threshold, the unit."""
    unit = f" {judged.unit}" if judged.unit else ""
    if judged.value is None:
        return f"{judged.name} unknown"
    value = f"{judged.name} {_figure(judged.value)}"
    if judged.threshold is None:
        return f"{value}{unit}"
    relation = "<" if judged.value < judged.threshold else ">" if judged.value > judged.threshold else "="
    return f"{value} {relation} {_figure(judged.threshold)}{unit}"


def _figure(value: float) -> str:
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"  # noqa: PLR2004 - digits shown, no decision


def _figures(each: Overview) -> tuple[str, str, str, str]:
    if each.summary is None:
        return "", "", "", _clock(each.seconds)
    lanes, switches = each.summary.lanes, each.summary.switches
    return (
        f"{lanes.done}/{lanes.total}",
        f"{switches.succeeded}/{switches.attempted}",
        f"{each.summary.distance_m:.1f} m",
        _clock(each.summary.duration_s),
    )


def _outcome(each: Overview) -> Text:
    return Text(each.outcome.value, style=COLOURS[each.outcome])


def _ending(each: Overview) -> Text:
    """The last state, and why it was entered."""
    parts = [Text(each.last_state)] if each.last_state else []
    return Text(": ").join([*parts, Text(each.reason, style="bold")] if each.reason else parts)


def _clock(seconds: float) -> str:
    if not isfinite(seconds):
        return "unknown"
    minutes, rest = divmod(seconds, SECONDS_A_MINUTE)
    return f"{int(minutes)}:{rest:04.1f}"
