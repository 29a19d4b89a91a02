"""The tables of `fieldnav log stats`."""

from collections.abc import Sequence
from statistics import median

from rich.table import Table

from fieldnav.cli.console import table
from fieldnav.cli.log.near_misses import Missed
from fieldnav.inquiry.figure_words import lateness
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.spent import Account
from fieldnav.inquiry.tally import NO_LANE, Tally
from fieldnav.inquiry.words import counted, figure, judgements, measured
from fieldnav.journal.summary import Summary


def states_table(spent: Account) -> Table:
    """Where the time and the way went, the most first."""
    whole_s = spent.seconds or 1.0
    by_time = sorted(spent.states.items(), key=lambda each: -each[1].seconds)
    rows = [
        (
            state,
            clock(in_it.seconds),
            f"{in_it.seconds / whole_s:.1%}",
            f"{in_it.metres:.1f} m",
            str(in_it.entries),
            f"{in_it.seconds / max(1, in_it.entries):.1f} s",
        )
        for state, in_it in by_time
    ]
    columns = ("state", "time", "share", "way", "times", "mean")
    return table("time and way in each state", columns, rows, right=columns[1:])


def lanes_table(made: Tally) -> Table:
    """What happened in each lane."""
    rows = [
        (
            "none" if lane == NO_LANE else str(lane),
            *map(str, (each.transitions, each.coastings, each.holds, each.stops)),
        )
        for lane, each in sorted(made.lanes.items())
    ]
    columns = ("lane", "transitions", "coastings", "holds and notes", "stops")
    return table("each lane", columns, rows, right=columns)


def events_table(made: Tally) -> Table:
    """By how much each condition was met when its event came about; not of counts, which are met exactly."""
    told = {of: margins for of, margins in sorted(made.margins.items()) if any(margins)}
    rows = [
        (event, name, str(len(margins)), *_spread(margins, unit))
        for (event, name, unit), margins in told.items()
    ]
    columns = ("event", "condition", "times", "least", "median", "most")
    return table("margins by which events came about", columns, rows, right=columns[2:])


def left_out(made: Tally) -> str:
    """Which conditions that table leaves out."""
    exact = sum(not any(margins) for margins in made.margins.values())
    return (
        f"{counted(exact, 'condition')} without a margin: a count that had just been reached" if exact else ""
    )


def _spread(margins: Sequence[float], unit: str) -> tuple[str, str, str]:
    return figure(min(margins)), figure(median(margins)), measured(max(margins), unit)


def troubles_table(made: Tally) -> Table:
    """Stops and holds by their kind."""
    kinds = sorted({*made.faults, *made.holds}, key=lambda kind: (-made.faults[kind], kind))
    rows = [(kind, str(made.faults[kind]), str(made.holds[kind])) for kind in kinds]
    return table(
        "stops and holds", ("kind", "stops", "holds and notes"), rows, right=("stops", "holds and notes")
    )


def missed_table(missed: Missed) -> Table:
    """The events that nearly came about, the closest first."""
    rows = [
        (
            clock(miss.step.now_s),
            str(miss.step.lane),
            f"{miss.chance.event}\nin {miss.step.state}",
            f"{miss.lacking:.1%}",
            judgements(miss.chance.deciding),
        )
        for miss in missed.misses
    ]
    columns = ("time", "lane", "event", "lacked", "by")
    return table("nearly came about, and did not", columns, rows, right=("time", "lane", "lacked"))


def loop_line(summary: Summary | None) -> str:
    """How late the loop's rounds began."""
    loop = summary.loop if summary else None
    if loop is None:
        return "lateness of the loop: not known; only a run on a robot's clock has one"
    return f"lateness of the loop: {lateness(loop)}"
