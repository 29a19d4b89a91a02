"""The tables of `fieldnav log`."""

from collections.abc import Sequence

from rich.table import Table
from rich.text import Text

from fieldnav.cli.console import table
from fieldnav.inquiry.chances import deciding
from fieldnav.inquiry.line_words import states_of
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.outcome import Outcome, Overview
from fieldnav.inquiry.words import decisive, judgement
from fieldnav.journal.entry import Line
from fieldnav.settings.one_line import one_line

COLOURS = {
    Outcome.FINISHED: "green",
    Outcome.STOPPED: "red",
    Outcome.BROKEN_OFF: "yellow",
    Outcome.RUNNING: "cyan",
    Outcome.UNREADABLE: "yellow",
}
WIDE = 110
"""Columns from which on a transition's states stand side by side."""


def runs_table(title: str, overviews: Sequence[Overview], width: int = WIDE) -> Table:
    """One line a run; where there is little room the ending stands beneath the name."""
    if width < WIDE:
        columns: tuple[str, ...] = ("run", "outcome", "lanes", "way", "time")
        rows = [_short(each) for each in overviews]
    else:
        columns = ("run", "outcome", "lanes", "switches", "distance", "time", "stops", "ended in")
        rows = [
            (one_line(each.run), _outcome(each), *_figures(each), _stops(each), _ending(each))
            for each in overviews
        ]
    return table(
        f"runs in {title}", columns, rows, right=("lanes", "switches", "distance", "way", "time", "stops")
    )


def _short(each: Overview) -> tuple[str | Text, ...]:
    lanes, _, distance, time = _figures(each)
    ending = [_ending(each)] if each.outcome is not Outcome.FINISHED else []
    return (
        Text("\n").join([Text(one_line(each.run), style="bold"), *ending]),
        _outcome(each),
        lanes,
        distance,
        time,
    )


def heading(each: Overview) -> Text:
    """How one run ended, above its transitions."""
    lanes, switches, distance, time = _figures(each)
    told = [f"lanes {lanes}"] if lanes else []
    told += [f"switches {switches}, {distance} in {time}"] if each.summary else [f"{time} written down"]
    ending = "" if each.outcome is Outcome.FINISHED else Text.assemble("\n", _ending(each))
    return Text.assemble(
        (one_line(each.run), "bold"), "  ", _outcome(each), f"  {', '.join(told)}", ending, "\n"
    )


def transitions_table(lines: Sequence[Line], width: int = WIDE) -> Table:
    """One line a transition: its reason, then what was judged; fewer columns where there is little room."""
    if width < WIDE:
        return _narrow(lines)
    columns = ("seq", "time", "from", "to", "event", "lane", "rows", "because")
    rows = [
        (
            str(line.seq),
            clock(line.stamp_s),
            line.source,
            line.target,
            line.event,
            "" if line.lane is None else str(line.lane),
            "" if line.rows is None else str(line.rows),
            Text("\n").join(_because(line)),
        )
        for line in lines
    ]
    return table("", columns, rows, right=("seq", "time", "lane", "rows"))


def _narrow(lines: Sequence[Line]) -> Table:
    """From where to where above the reasons."""
    rows = [
        (
            str(line.seq),
            clock(line.stamp_s),
            "" if line.lane is None else str(line.lane),
            Text("\n").join([Text(one_line(f"{line.event}: {states_of(line)}")), *_because(line)]),
        )
        for line in lines
    ]
    return table(
        "", ("seq", "time", "lane", "event, and because of what"), rows, right=("seq", "time", "lane")
    )


def _because(line: Line) -> list[Text]:
    """The reason, which stands out where there is one, above the deciding quantities."""
    reason = [Text(one_line(line.reason), style="bold")] if line.reason else []
    judged = deciding(line.event, line.evidence) or decisive(line.evidence)
    return [*reason, *(Text(one_line(judgement(each))) for each in judged)]


def _figures(each: Overview) -> tuple[str, str, str, str]:
    lanes = f"{each.lanes.done}/{each.lanes.total}" if each.lanes else ""
    if each.summary is None:
        return lanes, "", "", clock(each.seconds)
    switches = each.summary.switches
    return (
        lanes,
        f"{switches.succeeded}/{switches.attempted}",
        f"{each.summary.distance_m:.1f} m",
        clock(each.summary.duration_s),
    )


def _stops(each: Overview) -> str:
    return str(each.summary.faults) if each.summary else ""


def _outcome(each: Overview) -> Text:
    return Text(each.outcome.value, style=COLOURS[each.outcome])


def _ending(each: Overview) -> Text:
    """The last state, and why it was entered."""
    parts = [Text(one_line(each.last_state))] if each.last_state else []
    return Text(": ").join([*parts, Text(one_line(each.reason), style="bold")] if each.reason else parts)
