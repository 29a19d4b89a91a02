"""What a wheel module can say at all; the rest is a garbled frame, or somebody else's."""

from collections.abc import Mapping

from drivers.module_units import speed_from_rpm, steering_from_counts
from drivers.thorvald_protocol import Kind, NodeState
from drivers.wire_layout import Telegram
from fieldnav.settings.robot import Module

OVER_TOP = 1.3
"""Of the top speed and of the steering limit: downhill, and beyond the limit by the servo's overshoot."""
COLDEST_C, HOTTEST_C = -50, 200
MOST_V = 100
NODE_STATES = frozenset(state.value for state in NodeState)


def plausible(telegram: Telegram, module: Module) -> bool:
    """Whether a module of that kind can mean it; a telegram without values could not be read."""
    values = telegram.values
    if not values:
        return False
    match telegram.kind:
        case Kind.MOTION:
            return _possible_motion(values, module)
        case Kind.HEALTH:
            hot = COLDEST_C <= values["HighestTemperature"] <= HOTTEST_C
            return hot and 0 <= values["BatteryVoltage"] <= MOST_V
        case Kind.HEARTBEAT:
            return int(values["State"]) in NODE_STATES
        case _:
            return True


def _possible_motion(values: Mapping[str, float], module: Module) -> bool:
    speed_mps = speed_from_rpm(module, values["DriveMotorSpeed"])
    steering_rad = steering_from_counts(module, values["SteeringCounts"])
    in_reach = abs(steering_rad) <= OVER_TOP * module.steering_limit_rad
    return in_reach and abs(speed_mps) <= OVER_TOP * module.top_speed_mps
