"""How the run ended, in a sentence, and its figures at a glance."""

from collections.abc import Sequence
from dataclasses import dataclass

from fieldnav.inquiry.figure_words import finished
from fieldnav.inquiry.line_words import in_lane
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.outcome import Outcome, Overview
from fieldnav.inquiry.words import counted
from fieldnav.journal.summary import Lanes
from fieldnav.report.material import Material
from fieldnav.report.spans import distance_m
from fieldnav.report.stops import Kind, Stop
from fieldnav.report.words import fixed, sentence, stopped


@dataclass(frozen=True, slots=True)
class Headline:
    """outcome colours it; figures: a label and a value each."""

    outcome: Outcome
    sentence: str
    figures: tuple[tuple[str, str], ...]


def headline(material: Material, ended: Overview, stops: Sequence[Stop], end_s: float) -> Headline:
    """The first thing that is read."""
    lanes = ended.lanes or _lanes_asked_for(material)
    driven_m = material.summary.distance_m if material.summary else distance_m(material.lines)
    begin_s = material.lines[0].stamp_s if material.lines else 0.0
    figures = [
        ("lanes", f"{lanes.done} of {lanes.total}" if lanes else ""),
        ("distance", fixed(driven_m, 1, "m") if driven_m is not None else ""),
        ("time", clock(end_s - begin_s) if material.lines else ""),
        *_switches(material),
        ("stops and pauses", str(sum(stop.kind in (Kind.STOP, Kind.PAUSE) for stop in stops))),
        ("holds", str(sum(stop.kind is Kind.HOLD for stop in stops))),
    ]
    said = f"{_ending(material, ended, stops)} {_done(lanes)}".strip()
    return Headline(ended.outcome, said, tuple((label, value) for label, value in figures if value))


def _lanes_asked_for(material: Material) -> Lanes | None:
    """Of a run that was not far enough to note any; None where nothing was written down."""
    options = material.settings.get("options")
    total = options.get("lanes") if isinstance(options, dict) else None
    return Lanes(done=0, total=total) if isinstance(total, int) and material.lines else None


def _ending(material: Material, ended: Overview, stops: Sequence[Stop]) -> str:
    if ended.outcome is Outcome.UNREADABLE:
        return sentence(f"the run cannot be read: {ended.reason}")
    if not material.lines:
        return "The run has no journal lines: it ended before it began."
    last, stop = material.lines[-1], stops[-1] if stops else None
    if ended.outcome is Outcome.FINISHED:
        return sentence(finished(material.summary))
    where = f"at {clock(last.stamp_s)}{in_lane(last.lane)}"
    if ended.outcome is Outcome.RUNNING:
        return f"Still being driven: {where} it was in {last.target}."
    if stop is None or stop.kind not in (Kind.STOP, Kind.PAUSE):
        return f"Ended {where} in {last.target}, without a stop."
    at = f"at {clock(stop.line.stamp_s)}{in_lane(stop.line.lane)}"
    verb = "Broken off" if ended.outcome is Outcome.BROKEN_OFF else "Stopped"
    return f"{verb} {at}, in {stop.line.source}: {stopped(stop.cause.said)}"


def _done(lanes: Lanes | None) -> str:
    return f"{lanes.done} of {counted(lanes.total, 'lane')} done." if lanes else ""


def _switches(material: Material) -> list[tuple[str, str]]:
    if material.summary is None:
        return []
    switches = material.summary.switches
    return [("lane switches", f"{switches.succeeded} of {switches.attempted}")] if switches.attempted else []
