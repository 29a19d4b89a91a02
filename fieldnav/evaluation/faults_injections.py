"""Every way in which a fault occurs, for each of the table of faults at least one."""

from dataclasses import replace

from fieldnav.evaluation.faults_injection import Injection
from fieldnav.evaluation.faults_on_cameras import of_cameras
from fieldnav.evaluation.faults_on_host import of_bus, of_host
from fieldnav.evaluation.faults_on_modules import of_modules
from fieldnav.faults import Reaction


def injections() -> tuple[Injection, ...]:
    """All of them; a fault that is held for occurs twice, once to last and once to pass."""
    made: list[Injection] = []
    for each in (*of_cameras(), *of_modules(), *of_bus(), *of_host()):
        made.append(each)
        if each.reaction is Reaction.HOLD:
            made.append(replace(each, passing=True))
    return tuple(made)
