"""Puts together what the page shows of a run."""

from collections.abc import Sequence
from datetime import UTC, datetime

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.evidence_rows import condition_rows, evidence_rows
from fieldnav.inquiry.near_misses import NearMiss
from fieldnav.inquiry.outcome import Outcome, overview
from fieldnav.inquiry.stops import stands
from fieldnav.journal.resolved import DRIVEN_UTC, read_settings
from fieldnav.report.chart import chart_of
from fieldnav.report.curves import driving_panels, health_panels
from fieldnav.report.drawn_map import map_of
from fieldnav.report.headline import headline
from fieldnav.report.health import health_of, truth_of
from fieldnav.report.lanes import lanes_of
from fieldnav.report.material import Material
from fieldnav.report.page import Page, ToldNearMiss, ToldStop
from fieldnav.report.pictures import Pictures
from fieldnav.report.settings_list import settings_groups
from fieldnav.report.spans import Span, end_of, seconds_by_phase, spans_of
from fieldnav.report.stops import Kind, Stop, stops_of
from fieldnav.settings.robot import Robot

MOST_STOPS, MOST_PICTURES = 40, 12
"""Shown with all that is known of them; and of these the ones with a picture, some 60 kB each."""
MOST_LINES = 3000
"""Of the journal in the table at the end, some 300 bytes each."""
PICTURED_FIRST = (Kind.STOP, Kind.PAUSE, Kind.HOLD, Kind.NOTE)


def compose(material: Material, pictures: Pictures) -> Page:
    """Everything that the page shows."""
    ended, lines = overview(material.directory), material.lines
    spans, stops, end_s = stretches(material)
    told = _told(stops, pictures)
    health = health_panels(material)
    marks = [(each.stop.line.stamp_s, str(each.number)) for each in told if each.stop.kind is not Kind.NOTE]
    return Page(
        name=material.directory.path.name,
        began=_began(material),
        headline=headline(material, ended, stops, end_s),
        missing=_missing(material, ended.outcome),
        map=map_of(material),
        lanes=lanes_of(material, spans, _robot(material)),
        truth=truth_of(material),
        phases=seconds_by_phase(spans),
        driving=chart_of(driving_panels(material), spans, marks, end_s),
        stops=told,
        stops_left_out=max(0, len(stops) - len(told)),
        near_misses=[_near_miss(miss, pictures) for miss in material.near_misses],
        recorded=material.recorded,
        health=health_of(material),
        health_chart=chart_of(health, (), (), end_s) if health else None,
        lines=lines[-MOST_LINES:],
        lines_left_out=max(0, len(lines) - MOST_LINES),
        settings=settings_groups(material.settings),
    )


def _began(material: Material) -> str:
    """When the run began; of a simulated one also when it was really driven, where its settings say."""
    if not material.lines:
        return ""
    began = _time_of(material.lines[0].utc)
    if "field" not in material.settings:
        return began
    options = material.settings.get("options")
    driven = options.get(DRIVEN_UTC) if isinstance(options, dict) else None
    try:
        really = f"; really driven {_time_of(datetime.fromisoformat(str(driven)))}"
    except (ValueError, OverflowError):
        really = ""
    return f"{began} by the simulated clock{really}"


def _time_of(utc: datetime) -> str:
    return f"{utc.astimezone(UTC):%Y-%m-%d %H:%M:%S} UTC"


def stretches(material: Material) -> tuple[list[Span], list[Stop], float]:
    """The states one after the other, the stops among them, and when the run ended."""
    summary, lines = material.summary, material.lines
    others_s = [*map(float, material.trail.time_s[-1:]), *(each.stamp_s for each in material.bookings[-1:])]
    end_s = end_of(lines, summary.duration_s if summary else None, others_s)
    spans = spans_of(lines, end_s)
    return spans, stops_of(lines, spans, end_s if _killed(material) else None), end_s


def _killed(material: Material) -> bool:
    """Whether the journal ends in the middle of a mission that nobody drives any more."""
    if not material.lines or stands(material.lines[-1]):
        return False
    return overview(material.directory).outcome is Outcome.BROKEN_OFF


def _told(stops: Sequence[Stop], pictures: Pictures) -> list[ToldStop]:
    """The newest with a number each, the gravest of them with pictures."""
    first = max(0, len(stops) - MOST_STOPS)
    shown = list(enumerate(stops[first:], start=first + 1))
    gravest = sorted(shown, key=lambda each: PICTURED_FIRST.index(each[1].kind))[:MOST_PICTURES]
    pictured = {number for number, _ in gravest}
    return [_told_stop(number, stop, pictures, number in pictured) for number, stop in shown]


def _told_stop(number: int, stop: Stop, pictures: Pictures, pictured: bool) -> ToldStop:
    """What it was decided on; of one that came from outside what was judged last before it."""
    line, before = stop.line, None
    if not line.evidence and stop.kind is not Kind.NOTE:
        before = pictures.step_of(line)
    return ToldStop(
        number=number,
        stop=stop,
        rows=evidence_rows(before.evidence, "") if before else evidence_rows(line.evidence, line.event),
        judged_before=before is not None,
        led=evidence_rows(stop.led.evidence, stop.led.event) if stop.led else (),
        picture=pictures.of_line(line) if pictured else None,
    )


def _near_miss(miss: NearMiss, pictures: Pictures) -> ToldNearMiss:
    rows = condition_rows(miss.chance.conditions, miss.chance.deciding)
    return ToldNearMiss(miss, rows, pictures.of_step(miss.step))


def _missing(material: Material, outcome: Outcome) -> list[str]:
    """What a reader would look for and does not find, and why."""
    said = [*material.problems]
    if material.summary is None and outcome is not Outcome.UNREADABLE:
        said.append("There is no summary.json: the run was broken off, or it is still under way.")
    if not material.settings:
        said.append("There are no settings to be read.")
    if not material.recorded:
        said.append(
            "There is no recording: no pictures, no near misses, no errors lane by lane, and curves only of "
            "what the journal says."
        )
    return said


def _robot(material: Material) -> Robot | None:
    """The robot's settings; None where they are not what this version reads, which costs one column."""
    try:
        return read_settings(material.directory.settings).robot
    except FieldnavError:
        return None
