"""The page: everything that is shown, handed to the template, which escapes all text."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from math import isfinite

from jinja2 import Environment, FunctionLoader, StrictUndefined
from markupsafe import Markup, escape

from fieldnav import __version__
from fieldnav.inquiry.chances import deciding
from fieldnav.inquiry.evidence_rows import Row
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.near_misses import NearMiss
from fieldnav.inquiry.outcome import Outcome
from fieldnav.inquiry.words import counted, judgement
from fieldnav.journal.entry import Line
from fieldnav.journal.phases import INK, PHASE_COLOURS
from fieldnav.report.drawn_map import ReportMap
from fieldnav.report.embedded import Shown
from fieldnav.report.headline import Headline
from fieldnav.report.health import Facts
from fieldnav.report.lanes import Lane
from fieldnav.report.shapes import Chart
from fieldnav.report.stops import Stop
from fieldnav.report.words import NOTHING, fixed, known, sentence

BREAK = re.compile(r"([._])(?=\w)")
LEAST_SHARE = 0.01
OUTCOME_COLOURS = {
    Outcome.FINISHED: "#2c7a3f",
    Outcome.STOPPED: PHASE_COLOURS["Fault"],
    Outcome.BROKEN_OFF: "#a85b00",
    Outcome.RUNNING: PHASE_COLOURS["Follow"],
    Outcome.UNREADABLE: "#a85b00",
}


@dataclass(frozen=True, slots=True)
class ToldStop:
    """A stop with its number, what was judged, and its picture if there is one.

    judged_before: it came from outside, and this is what was judged last before it. led: what had been judged
    by the transition just before, of which it is a consequence.
    """

    number: int
    stop: Stop
    rows: Sequence[Row]
    judged_before: bool
    led: Sequence[Row]
    picture: Shown | None


@dataclass(frozen=True, slots=True)
class ToldNearMiss:
    """A near miss with its conditions, and its picture if there is one."""

    miss: NearMiss
    rows: Sequence[Row]
    picture: Shown | None


@dataclass(frozen=True, slots=True)
class Page:
    """What the template shows, in the order in which it is read."""

    name: str
    began: str
    headline: Headline
    missing: Sequence[str]
    map: ReportMap | None
    lanes: Sequence[Lane]
    truth: Facts
    phases: Mapping[str, float]
    driving: Chart
    stops: Sequence[ToldStop]
    stops_left_out: int
    near_misses: Sequence[ToldNearMiss]
    recorded: bool
    health: Facts
    health_chart: Chart | None
    lines: Sequence[Line]
    lines_left_out: int
    settings: Sequence[tuple[str, Sequence[tuple[str, str]]]]


def render(page: Page) -> str:
    """The page as HTML. All text is escaped; only the style comes as it is."""
    environment = Environment(
        loader=FunctionLoader(_own),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "breakable": breakable,
        "clock": clock,
        "counted": counted,
        "deciding": lambda line: deciding(line.event, line.evidence),
        "fixed": fixed,
        "judgement": judgement,
        "known": known,
        "percent": percent,
        "sentence": sentence,
    }
    environment.globals |= {
        "colours": PHASE_COLOURS,
        "ink": INK,
        "nothing": NOTHING,
        "outcome_colours": OUTCOME_COLOURS,
        "style": Markup(_own("report.css")),
        "version": __version__,
    }
    return environment.get_template("report.html.jinja").render(page=page)


def breakable(name: str) -> Markup:
    """A long name with places at which a line may be broken."""
    return Markup(BREAK.sub(r"\1<wbr>", str(escape(name))))


def percent(share: float) -> str:
    """A share as people say it; the dash where it is not known."""
    if not isfinite(share):
        return NOTHING
    return "less than 1 %" if 0 < share < LEAST_SHARE else f"{100 * share:.0f} %"


def _own(name: str) -> str:
    """A file that lies beside this one."""
    return files("fieldnav.report").joinpath(name).read_text(encoding="utf-8")
