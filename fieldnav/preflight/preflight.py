"""The pre-flight: every check in its turn, for `fieldnav check` and before a mission. Nothing moves.

It takes 4 s for the bus, 3 s for the cameras and some tenths to look at their pictures, at the most.
"""

from collections.abc import Iterator

import can

from fieldnav.messages import CameraName
from fieldnav.preflight.battery_check import battery
from fieldnav.preflight.bus_checks import NETWORK, counters, errors, other_hosts, state_of, traffic
from fieldnav.preflight.camera_checks import camera_findings, two_cameras
from fieldnav.preflight.computer import Computer
from fieldnav.preflight.computer_checks import computer_findings
from fieldnav.preflight.finding import Finding
from fieldnav.preflight.gear import Gear
from fieldnav.preflight.listening import listen
from fieldnav.preflight.module_checks import modules
from fieldnav.preflight.pose_checks import pose_findings
from fieldnav.preflight.row_checks import row_findings
from fieldnav.preflight.sampling import sample
from fieldnav.preflight.waiting import Watch
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.robot import Robot


def preflight(
    robot: Robot, crop: CropProfile | None, gear: Gear, computer: Computer, watch: Watch
) -> Iterator[Finding]:
    """Every check of what is open; with a crop also what the cameras see of it.

    What could not be opened has been told of by who opened it. The bus and the cameras stay open. Raises
    SettingsError for a node id that the DBC file lacks.
    """
    yield from computer_findings(computer)
    if gear.bus is not None:
        yield from _of_bus(robot, gear.bus, watch)
    yield from _of_cameras(robot, crop, gear, watch)


def _of_bus(robot: Robot, bus: can.BusABC, watch: Watch) -> Iterator[Finding]:
    statistics = NETWORK / robot.can.channel / "statistics"
    before = counters(statistics)
    hearing = listen(robot, bus, watch)
    yield traffic(hearing, robot.can)
    yield errors(hearing, state_of(bus), before, counters(statistics))
    if hearing.failure:
        return
    yield other_hosts(hearing)
    yield from modules(hearing)
    yield battery(hearing.battery, robot.battery)


def _of_cameras(robot: Robot, crop: CropProfile | None, gear: Gear, watch: Watch) -> Iterator[Finding]:
    taken = sample(gear.cameras, watch)
    newest = {name: each.frames[-1] for name, each in taken.items() if each.frames and not each.failure}
    for name, each in taken.items():
        settings = robot.cameras.get(name)
        yield from camera_findings(name, each, settings)
        if crop is not None and name in newest:
            yield from pose_findings(newest[name], crop, settings.pinhole(), robot.camera_limits)
            yield from row_findings(newest[name], crop, settings.pinhole())
    yield two_cameras({name: robot.cameras.get(name) for name in CameraName}, newest)
