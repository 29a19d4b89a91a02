"""The check of each wheel module: there, up, the one of the robot file, well, and at rest."""

from collections.abc import Iterator
from math import degrees

from drivers.module_link import ModuleLink
from drivers.module_watch import objection
from fieldnav.faults import FAULTS
from fieldnav.messages import ModuleReport, Wheel
from fieldnav.preflight.finding import Concern, Finding, Verdict, finding_of
from fieldnav.preflight.hearing import Hearing

HOT_C, TOO_HOT_C = 70, 85
"""Of the controller; our choice: a mission warms it further."""
AT_REST_MPS = 0.01
"""Our choice: 20 motor revolutions a minute."""
SLACK_RAD = 0.02
"""A wheel that stands at its limit may say so much more; our choice."""
SEE_TO_POWER = "see to its power and its plug"


def modules(hearing: Hearing) -> Iterator[Finding]:
    """A finding for each module."""
    for wheel, link in hearing.links.items():
        yield finding_of(f"module {wheel.value}", _figure(link), list(_concerns(hearing, wheel, link)))


def _concerns(hearing: Hearing, wheel: Wheel, link: ModuleLink) -> Iterator[Concern]:
    node, kinds = f"node {link.module.node_id}", hearing.kinds[wheel]
    if not kinds:
        yield Concern(Verdict.FAIL, f"{node}: nothing heard", SEE_TO_POWER)
        return
    if hearing.garbled[wheel]:
        words = f"{hearing.garbled[wheel]} telegrams say what cannot be"
        yield Concern(Verdict.WARNING, words, "see to cable and termination")
    if link.rebooted:
        yield Concern(Verdict.FAIL, "it left operation or rebooted while it was watched", SEE_TO_POWER)
    yield from _readiness(link, hearing.started)
    if link.trouble is not None:
        words = f"{link.trouble.fault.value}: {link.trouble.said.removeprefix(link.name).lstrip(': ')}"
        yield Concern(Verdict.FAIL, words, FAULTS[link.trouble.fault].advice)
    if link.report is not None:
        yield from _condition(link, link.report)


def _readiness(link: ModuleLink, started: bool) -> Iterator[Concern]:
    """Whether it is up and the one of the robot file."""
    objected = objection(link)
    if objected is not None:
        words = objected.removeprefix(link.name).lstrip(": ")
        yield Concern(Verdict.FAIL, words, "set the module or the robot file right")
    missing = link.missing
    if missing is not None and not started:
        yield Concern(Verdict.WARNING, "not brought up, since another host is there", "check again alone")
    elif missing is not None:
        state = f", it is {link.state.name.lower().replace('_', '-')}" if link.state is not None else ""
        yield Concern(Verdict.FAIL, f"has not told {missing.value}{state}", "see to its script")
    elif link.version is None:
        yield Concern(Verdict.WARNING, "has not told its script's version (TPDO4)", "see to its script")


def _condition(link: ModuleLink, report: ModuleReport) -> Iterator[Concern]:
    """Whether it is cool and stands still."""
    if report.temperature_c >= HOT_C:
        verdict = Verdict.FAIL if report.temperature_c >= TOO_HOT_C else Verdict.WARNING
        words = f"{report.temperature_c:.0f} C; {HOT_C} C is hot, {TOO_HOT_C} C too hot"
        yield Concern(verdict, words, "let it cool")
    if abs(report.speed_mps) > AT_REST_MPS:
        words = f"turns at {report.speed_mps:.2f} m/s without being told"
        yield Concern(Verdict.FAIL, words, "press the emergency stop; see to its drive encoder")
    limit_rad = link.module.steering_limit_rad
    if abs(report.steering_rad) > limit_rad + SLACK_RAD:
        words = f"stands at {degrees(report.steering_rad):.1f} deg, limit {degrees(limit_rad):.1f}"
        yield Concern(Verdict.FAIL, words, "see to its homing and encoder_pulses")


def _figure(link: ModuleLink) -> str:
    """A module that is well, in a few words."""
    report = link.report
    if report is None or link.version is None:
        return ""
    version = ".".join(map(str, link.version))
    told = (
        f"at {degrees(report.steering_rad):.1f} deg, {report.temperature_c:.0f} C, {report.battery_v:.1f} V"
    )
    return f"node {link.module.node_id}, operational, script {version}, {told}"
