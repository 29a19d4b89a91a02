"""Listening to the bus: first in silence, for who else is there, then with the modules brought up."""

from contextlib import suppress

import can

from drivers.reopened_bus import BUS_ERRORS
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import DriverError
from fieldnav.preflight.hearing import Ear, Hearing
from fieldnav.preflight.waiting import Watch
from fieldnav.settings.robot import Robot

SILENCE_S = 1.0
"""Ten periods of another host's heartbeat."""
TELLING_S = 3.0
"""A module tells both parts of its identity within 2 s, the battery its charge within 1 s."""
COUNTING_S = 1.0
TICK_S = 0.02


def listen(robot: Robot, bus: can.BusABC, watch: Watch) -> Hearing:
    """All that is heard within SILENCE_S and TELLING_S at most.

    No wheel turns: what is sent is zero speed, the start of each node, the mode "drive", the host's
    heartbeat, and the questions for fault flags and mode. Where another host is heard first, nothing is sent.
    """
    hearing = Hearing(robot)
    ear = Ear(bus, hearing, watch.clock)
    try:
        _overhear(ear, hearing, watch)
        if not hearing.foreign:
            _bring_up(ThorvaldWheels(robot, ear), hearing, watch)
    except (DriverError, *BUS_ERRORS) as error:
        hearing.failure = hearing.failure or str(error)
    finally:
        ear.shutdown()
    return hearing


def _overhear(ear: Ear, hearing: Hearing, watch: Watch) -> None:
    """Take in what comes without a word."""
    hearing.begin(watch.clock())
    while hearing.counted_s < SILENCE_S:
        if ear.recv(timeout=0) is None:
            watch.wait(TICK_S)
        hearing.ended_s = watch.clock()


def _bring_up(wheels: ThorvaldWheels, hearing: Hearing, watch: Watch) -> None:
    """Start the modules and let them tell. Raises DriverError when the bus refuses."""
    hearing.begin(watch.clock())
    hearing.started = True
    wheels.start(watch.clock())
    while hearing.counted_s < TELLING_S and not hearing.failure:
        watch.wait(TICK_S)
        # What is not well with a module shows in the hearing; here they shall only go on telling.
        with suppress(DriverError):
            wheels.poll(watch.clock())
        hearing.ended_s = watch.clock()
        if hearing.complete and hearing.counted_s >= COUNTING_S:
            return
