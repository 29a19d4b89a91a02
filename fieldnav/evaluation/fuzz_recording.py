"""Good telegrams to begin from: all that a host and its modules say, driven, stopped and set up."""

from functools import cache

import can
from can.interfaces.virtual import VirtualBus

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from drivers.thorvald_protocol import Kind, Mode, NmtCommand, Parameter
from drivers.wire_layout import NO_NODE, wire_layout
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.mission.loop import TICK_S
from fieldnav.settings.loading import load_robot

ROBOT = "bonnbot"
COMING_UP, DRIVING = 60, 110
"""Ticks of 20 ms; TPDO4 tells both its parts within 2 s."""
SPEED_MPS, ANGLE_RAD = 0.5, 0.2
MOST_OF_ONE_ID = 12
"""Telegrams that are kept of each identifier."""


@cache
def good_telegrams() -> tuple[can.Message, ...]:
    """Different telegrams of every identifier of the layout, in the order in which they were said."""
    host, far_end = open_virtual_pair()
    tap = VirtualBus(host.channel_info.rsplit(maxsplit=1)[-1], preserve_timestamps=True)
    try:
        _say_everything(host, far_end)
        return _different(tap)
    finally:
        for bus in (host, far_end, tap):
            bus.shutdown()


def _say_everything(host: can.BusABC, far_end: can.BusABC) -> None:
    robot = load_robot(ROBOT)
    modules, wheels = SimulatedModules(robot, far_end), ThorvaldWheels(robot, host)
    wheels.start(0.0)
    for tick in range(1, COMING_UP + DRIVING):
        now_s = tick * TICK_S
        modules.step(now_s)
        wheels.poll(now_s)
        point = WheelSetpoint(SPEED_MPS, ANGLE_RAD) if tick > COMING_UP else WheelSetpoint(0.0, 0.0)
        wheels.command(now_s, dict.fromkeys(Wheel, point))
    wheels.emergency_stop(now_s)
    modules.step(now_s + TICK_S)
    wheels.release_emergency_stop(now_s + TICK_S)
    for module in robot.modules.values():
        _say_the_rest(host, now_s + TICK_S, module.node_id)
    modules.step(now_s + 2 * TICK_S)


def _say_the_rest(host: can.BusABC, now_s: float, node: int) -> None:
    """What fieldnav's own host never says: other modes, set-up, the other NMT commands."""
    layout = wire_layout()
    for mode in (Mode.HOME, Mode.DECOUPLED, Mode.DRIVE):
        host.send(layout.frame(now_s, node, Kind.MODE, {"Mode": mode, "ModeRepeated": mode}))
    for parameter in Parameter:
        host.send(layout.frame(now_s, node, Kind.SET_UP, {"Parameter": parameter, "Value": 1}))
    for command in NmtCommand:
        host.send(layout.frame(now_s, NO_NODE, Kind.NMT, {"Command": command, "Node": node}))


def _different(tap: can.BusABC) -> tuple[can.Message, ...]:
    kept: dict[int, dict[bytes, can.Message]] = {}
    while (frame := tap.recv(timeout=0)) is not None:
        of_id = kept.setdefault(frame.arbitration_id, {})
        if len(of_id) < MOST_OF_ONE_ID:
            of_id[bytes(frame.data)] = frame
    return tuple(frame for of_id in kept.values() for frame in of_id.values())
