"""What `fieldnav log why` prints for a person: the cause first, then what it is known by."""

from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.text import Text

from fieldnav.cli.log.why_tables import events_table, judged_table, neighbours_table
from fieldnav.faults import FAULTS
from fieldnav.inquiry.asked import Asked
from fieldnav.inquiry.cause import led_here
from fieldnav.inquiry.chances import chances, deciding
from fieldnav.inquiry.evidence_rows import evidence_rows
from fieldnav.inquiry.headline import Headline, Kind
from fieldnav.inquiry.moment import clock
from fieldnav.journal.entry import Judged
from fieldnav.settings.one_line import one_line

if TYPE_CHECKING:
    from fieldnav.cli.log.recorded import Recorded

STYLES = {Kind.STOPPED: "bold red", Kind.BROKE_OFF: "bold red", Kind.PAUSED: "bold yellow"}
MOST_CHARTS, WIDEST = 3, 100
"""Quantities drawn besides speed and offset; columns of a chart. Our choice."""


def print_explanation(
    console: Console,
    asked: Asked,
    said: Headline,
    known: "Recorded | None",
    lacking: str,
    picture: Path | None,
) -> None:
    """known: of the half minute before; lacking: why nothing is known of it."""
    console.print(Text(one_line(said.text), style=STYLES.get(said.kind, "bold")), soft_wrap=True)
    fault = said.cause.fault
    if fault is not None:
        console.print(Text(f"look at: {FAULTS[fault].advice}", style="green"))
        console.print(Text(f"{fault.value} means: {FAULTS[fault].noticed}", style="dim"))
    _print_judged(console, asked, said)
    if known is None:
        console.print(Text(f"\n{one_line(lacking)}", style="dim"))
    else:
        _print_charts(console, asked, said, known)
    if picture is not None:
        console.print(Text(f"\npicture: {one_line(str(picture))}"), soft_wrap=True)
    console.print()
    console.print(neighbours_table(asked))


def _print_judged(console: Console, asked: Asked, said: Headline) -> None:
    state = asked.line.source if asked.happened else asked.line.target
    if not said.evidence:
        console.print(Text(f"\nof what {one_line(state)} judged nothing is written down here", style="dim"))
        return
    console.print()
    rows = evidence_rows(said.evidence, asked.line.event if asked.happened else "")
    console.print(judged_table(f"what {state} judged", rows))
    others = [chance for chance in chances(said.evidence) if not chance.holds]
    if others:
        console.print()
        console.print(events_table("did not happen, the nearest first", others))
    led = led_here(asked.line, asked.before) if asked.happened else None
    if led is not None:
        title = f"what {led.source} had judged just before, at {clock(led.stamp_s)}"
        console.print()
        console.print(judged_table(title, evidence_rows(led.evidence, led.event)))


def _print_charts(console: Console, asked: Asked, said: Headline, known: "Recorded") -> None:
    """The deciding quantities against their thresholds, then speed and place."""
    from fieldnav.cli.log.chart import chart  # noqa: PLC0415 - numpy is not needed without a recording
    from fieldnav.cli.log.recorded import BEFORE_S, courses  # noqa: PLC0415

    begin_s = max(min([asked.at_s - BEFORE_S, *[tick.now_s for tick in known.ticks[:1]]]), 0.0)
    console.print(
        Text(f"\nthe half minute before, from {clock(begin_s)} to {clock(asked.at_s)}", style="bold")
    )
    width = min(console.width, WIDEST)
    for course in courses(known, _drawn(asked, said)):
        for line in chart(course, (begin_s, asked.at_s), width, plain=console.options.ascii_only):
            console.print(Text(line), no_wrap=True, crop=True)
    for gap in known.gaps:
        said_of = f"{gap.frames} pictures are missing from {clock(gap.from_s)} to {clock(gap.to_s)}"
        console.print(Text(f"{said_of}: the disk was too slow", style="yellow"))


def _drawn(asked: Asked, said: Headline) -> tuple[Judged, ...]:
    """What made the event, else what the nearest events lacked; each quantity once."""
    made = deciding(asked.line.event, said.evidence) if asked.happened else ()
    nearest = [each for chance in chances(said.evidence) for each in chance.deciding]
    unique = {judged.name: judged for judged in reversed((*made, *nearest))}
    return tuple(reversed(unique.values()))[:MOST_CHARTS]
