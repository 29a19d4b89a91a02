"""What a pre-flight looks at, opened: the bus and the cameras."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

import can

from drivers.can_log import open_bus
from drivers.opencv_camera import open_camera
from drivers.ports import Camera
from drivers.reopened_bus import ReopenedBus
from fieldnav.errors import DriverError
from fieldnav.messages import CameraName
from fieldnav.preflight.finding import Finding, Verdict
from fieldnav.settings.robot import Bus, Robot
from fieldnav.settings.shown_source import shown

BITS_PER_KILOBIT = 1000


@dataclass(frozen=True, slots=True)
class Gear:
    """What could be opened: the bus, None where it could not, and each camera that could.

    reopen_bus: opens the bus again if it was lost; raises DriverError.
    """

    bus: can.BusABC | None
    cameras: Mapping[CameraName, Camera]
    reopen_bus: Callable[[], None] = lambda: None


@contextmanager
def opened(
    robot: Robot, clock: Callable[[], float], recorded: bool = False
) -> Iterator[tuple[Gear, tuple[Finding, ...]]]:
    """Open what there is, with a finding each, and close it again; `clock` is that of the cameras' stamps.

    recorded: live cameras give their frames as they are recorded.
    """
    with ExitStack() as stack:
        bus, findings = _bus(robot.can, stack)
        cameras = {}
        for name in CameraName:
            camera, finding = _camera(name, robot, clock, recorded, stack)
            findings.append(finding)
            if camera is not None:
                cameras[name] = camera
        reopen_bus = bus.reopen if bus is not None else lambda: None
        yield Gear(bus, cameras, reopen_bus), tuple(findings)


def _bus(settings: Bus, stack: ExitStack) -> tuple[ReopenedBus | None, list[Finding]]:
    try:
        bus = ReopenedBus(lambda: open_bus(settings))
    except DriverError as error:
        advice = "set the interface up, or can.interface and can.channel right"
        return None, [Finding("bus opens", Verdict.FAIL, str(error), advice)]
    stack.callback(bus.shutdown)
    rate = f"{settings.bitrate / BITS_PER_KILOBIT:g} kbit/s"
    return bus, [Finding("bus opens", Verdict.OK, f"{settings.interface} {settings.channel}, {rate}")]


def _camera(
    name: CameraName, robot: Robot, clock: Callable[[], float], recorded: bool, stack: ExitStack
) -> tuple[Camera | None, Finding]:
    check, settings = f"{name.value} camera opens", robot.cameras.get(name)
    try:
        camera = open_camera(name, settings, clock, robot.recording.quality if recorded else None)
    except DriverError as error:
        said = str(error).removeprefix(f"{name.value} camera: ")
        advice = f"see to its cable, or to cameras.{name.value}.source"
        return None, Finding(check, Verdict.FAIL, said, advice)
    stack.callback(camera.close)
    return camera, Finding(check, Verdict.OK, shown(settings.source))
