"""Before a run drives: the pre-flight, then its directory."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from datetime import datetime
from itertools import chain
from pathlib import Path

from drivers.listening_bus import ListeningBus
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.refused import removed_if_refused
from fieldnav.journal.resolved import write_settings
from fieldnav.mission.real import Order
from fieldnav.mission.taking_up import BrokenOff
from fieldnav.preflight.computer import read_computer
from fieldnav.preflight.finding import Finding, Verdict
from fieldnav.preflight.gear import Gear
from fieldnav.preflight.preflight import preflight
from fieldnav.preflight.waiting import Watch

OF_COMMANDS = ("other hosts", "module")
"""Checks that a dry run may fail."""


def silenced(gear: Gear) -> Gear:
    """The same gear for a dry run: nothing is said on the bus, so that a remote may drive."""
    return gear if gear.bus is None else replace(gear, bus=ListeningBus(gear.bus))


def cleared(
    order: Order,
    gear: Gear,
    findings: Iterable[Finding],
    runs: Path,
    clock: Callable[[], float],
    wait: Callable[[float], None],
    tell: Callable[[Finding], None],
) -> list[Finding]:
    """Look at everything, tell of it, and return what failed; findings: of the opening."""
    failed = []
    looked = preflight(order.robot, order.crop, gear, read_computer(runs), Watch(clock, wait))
    for finding in chain(findings, looked):
        judged = _allowing(finding) if order.dry_run else finding
        tell(judged)
        if judged.verdict is Verdict.FAIL:
            failed.append(judged)
    return failed


def _allowing(finding: Finding) -> Finding:
    """In a dry run a remote may drive, and modules that nobody brings up are silent."""
    mild = finding.verdict is not Verdict.FAIL or not finding.check.startswith(OF_COMMANDS)
    return finding if mild else replace(finding, verdict=Verdict.WARNING)


def begun(
    order: Order, known: BrokenOff | None, parent: Path, utc: datetime
) -> tuple[RunDirectory, datetime]:
    """The directory of a new run with its settings, or that of the one taken up; when it began.

    Raises OutputError.
    """
    if known is not None:
        return known.directory, known.begun_utc
    directory = RunDirectory.create(parent, order.robot.name, utc)
    options = {
        "lanes": order.lanes,
        "side": order.side.value,
        "dry_run": order.dry_run,
        "confirm": ", ".join(sorted(event.value for event in order.confirm)),
    }
    with removed_if_refused(directory):
        write_settings(directory.settings, order.crop, order.robot, options=options)
    return directory, utc
