"""How the robot and its computer fared: battery, temperature, loop, recording."""

from collections.abc import Iterable

import numpy as np

from fieldnav.inquiry.figure_words import against_truth, lateness
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.words import counted
from fieldnav.messages import Floats
from fieldnav.recording.records import Gap
from fieldnav.report.material import Material
from fieldnav.report.trail import Trail
from fieldnav.report.words import fixed

MS_A_SECOND = 1000
Facts = list[tuple[str, str]]


def health_of(material: Material) -> Facts:
    """A label and a value each; only what is known."""
    facts = [*_battery(material.trail), *_loop(material), *_recording(material)]
    if material.summary:
        facts += [("warning", warning) for warning in material.summary.warnings]
    return facts


def truth_of(material: Material) -> Facts:
    """What only a simulation knows; nothing on a robot."""
    truth = material.summary.truth if material.summary else None
    return against_truth(truth) if truth else []


def _battery(trail: Trail) -> Facts:
    charge, volts, degrees = map(_known, (trail.charge_percent, trail.battery_v, trail.temperature_c))
    facts = []
    if len(charge):
        facts.append(("battery", f"{charge[0]:.0f} % at the beginning, {charge[-1]:.0f} % at the end"))
    if len(volts):
        facts.append(("lowest voltage of a module", fixed(float(volts.min()), 1, "V")))
    if len(degrees):
        facts.append(("hottest module", fixed(float(degrees.max()), 0, "°C")))
    return facts


def _loop(material: Material) -> Facts:
    facts = []
    loop = material.summary.loop if material.summary else None
    if loop is not None:
        facts.append(("lateness of the loop", lateness(loop)))
    if len(material.trail) > 1:
        apart_ms = np.diff(material.trail.time_s) * MS_A_SECOND
        told = f"{np.median(apart_ms):.0f} ms in the median, at most {apart_ms.max():.0f} ms"
        facts.append(("ticks apart", told))
    if material.summary and material.summary.wall_s and loop is None:
        facts.append(("speed of the simulation", f"{material.summary.realtime_factor:.1f} x real time"))
    return facts


def _recording(material: Material) -> Facts:
    if not material.recorded:
        return [("recording", "none")]
    return [("gaps in the recording", gaps_told(material.gaps))]


def gaps_told(gaps: Iterable[Gap]) -> str:
    """When pictures are missing, and how many."""
    told = [f"{clock(gap.from_s)} to {clock(gap.to_s)} ({counted(gap.frames, 'picture')})" for gap in gaps]
    return "; ".join(told) or "none"


def _known(values: Floats) -> Floats:
    return values[np.isfinite(values)]
