"""Whether the modules are well: heard in time, not rebooted, those of the robot file, without a fault."""

from collections.abc import Collection

from drivers.module_faults import GRAVEST_FIRST
from drivers.module_link import MOST_GARBLED, Missing, ModuleLink
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind

START_LIMIT_S = 5.0
"""How long bringing up may take: twice the 2 s in which TPDO4 tells both its parts, and one; our choice."""


def objection(link: ModuleLink) -> str | None:
    """What about the module is not as in the robot file, with both values; else None."""
    if link.constants is not None:
        wanted = {"DriveDirection": link.module.drive_direction, "HomeCount": link.module.home_count}
        for quantity, expected in wanted.items():
            found = round(link.constants[quantity])
            if found != expected:
                return f"{link.name}: {quantity} is {found} in the module but {expected} in the robot file"
    return None


def check_modules(
    links: Collection[ModuleLink], now_s: float, starting_s: float, silence_limit_s: float
) -> None:
    """Raise DriverError for the first module that is not well; `starting_s` is when bringing up began.

    A module that is silent must tell everything anew before it may move; a reboot is an error once.
    """
    for link in links:
        link.silent = now_s - link.heard_s > silence_limit_s
        if link.silent:
            link.forget()
    _tell(links)
    for link in links:
        if link.silent:
            silence_s = now_s - link.heard_s
            raise DriverError(
                f"{link.name} has been silent for {silence_s:.2f} s, limit {silence_limit_s:.2f} s",
                FaultKind.MODULE_SILENT,
            )
        if link.garbled(now_s):
            link.begin(now_s)
            raise DriverError(
                f"{link.name} has said {MOST_GARBLED} times within a second what cannot be",
                FaultKind.BUS_GARBLED,
            )
        if link.rebooted:
            link.rebooted = False
            raise DriverError(f"{link.name} has left operation or rebooted", FaultKind.MODULE_REBOOTED)
        objected = objection(link)
        if objected is not None:
            raise DriverError(objected, FaultKind.MODULE_OTHER)
        if link.missing is not None and now_s - starting_s > START_LIMIT_S:
            late = f"has not told {link.missing.value} within {START_LIMIT_S:.0f} s"
            raise DriverError(
                f"{link.name} {link.unanswered or late}",
                FaultKind.MODULE_LATE if link.missing is Missing.MOTION else FaultKind.MODULE_SILENT,
            )


def _tell(links: Collection[ModuleLink]) -> None:
    """Raise DriverError once for each stop or failure that has begun, also for one that is over again."""
    untold = [trouble for link in links if (trouble := link.take_untold()) is not None]
    if untold:
        gravest = min((trouble.fault for trouble in untold), key=GRAVEST_FIRST.index)
        raise DriverError("; ".join(trouble.said for trouble in untold), gravest)
