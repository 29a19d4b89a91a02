"""What a simulated wheel module says: cyclic telegrams, emergencies and heartbeat, each when due."""

from collections.abc import Callable, Mapping

from drivers.module_units import speed_to_rpm, steering_rate_to_rpm, steering_to_counts
from drivers.simulated_module import SimulatedModule
from drivers.thorvald_protocol import FLAG_SIGNALS, IdentityPart, Kind, ModuleFlag, NodeState, Parameter

Said = tuple[Kind, Mapping[str, float]]

CYCLES_MS = {Kind.HEARTBEAT: 100, Kind.MOTION: 20, Kind.LOAD: 100, Kind.HEALTH: 100, Kind.IDENTITY: 1000}
"""Cycles of the telegrams; our choice, as the script's are not public."""

CYCLE_PARAMETERS = {
    Kind.MOTION: Parameter.CYCLE_MOTION,
    Kind.LOAD: Parameter.CYCLE_LOAD,
    Kind.HEALTH: Parameter.CYCLE_HEALTH,
    Kind.IDENTITY: Parameter.CYCLE_IDENTITY,
}

MODULE_TYPE = 1
VERSION = {"VersionMajor": 1, "VersionMinor": 0, "VersionPatch": 0}
"""What a simulated module calls itself."""

EXTERNAL_STOP, MOTOR_FAULT, LOW_VOLTAGE = 0x9000, 0x7100, 0x3120
"""Error codes of the emergency telegram (CiA 301)."""

MOST_PER_MILLE = 1000
HOME_SPEED_BITS, DRIVE_DIRECTION_BITS = 16, 8


class Voice:
    """Keeps one module's timetable; cycles run from the moment the module reached its state."""

    def __init__(self, module: SimulatedModule) -> None:
        self._module = module
        self._state: NodeState | None = None
        self._next_ms: dict[Kind, int] = {}
        self._earliest_ms = 0
        self._identities = 0
        self._flags = ModuleFlag.HEALTHY.value
        self._values: dict[Kind, Callable[[float], Mapping[str, float]]] = {
            Kind.HEARTBEAT: lambda _: {"State": self._module.state},
            Kind.MOTION: lambda _: self._motion(),
            Kind.LOAD: lambda _: self._load(),
            Kind.HEALTH: self._health,
            Kind.IDENTITY: lambda _: self._identity(),
        }

    def speak(self, now_ms: int, battery_v: float) -> list[Said]:
        """Everything that is due, in a fixed order. A module says its boot word once."""
        module = self._module
        if module.state is NodeState.BOOT:
            module.state, self._state = NodeState.PRE_OPERATIONAL, None
            return [(Kind.HEARTBEAT, {"State": NodeState.BOOT})]
        if module.state is not self._state:
            self._state, self._next_ms, self._identities = module.state, {}, 0
            self._earliest_ms = now_ms
        said = self._emergency()
        if now_ms < self._earliest_ms:
            return said
        for kind in CYCLES_MS if module.state is NodeState.OPERATIONAL else (Kind.HEARTBEAT,):
            if now_ms >= self._next_ms.setdefault(kind, now_ms):
                self._next_ms[kind] += self._cycle_ms(kind)
                if kind not in module.muted:
                    said.append((kind, self._values[kind](battery_v)))
        self._earliest_ms = min(self._next_ms.values())
        return said

    def _cycle_ms(self, kind: Kind) -> int:
        parameter = CYCLE_PARAMETERS.get(kind)
        set_ms = self._module.cycles_ms.get(parameter) if parameter else None
        return set_ms or CYCLES_MS[kind]

    def _motion(self) -> Mapping[str, float]:
        motion, module = self._module.motion, self._module.module
        return {
            "DriveMotorSpeed": speed_to_rpm(module, motion.speed_mps),
            "SteeringMotorSpeed": steering_rate_to_rpm(module, motion.steering_rate_rps),
            "SteeringCounts": steering_to_counts(module, motion.steering_rad),
        }

    def _load(self) -> Mapping[str, float]:
        motion, module = self._module.motion, self._module.module
        return {
            "DriveCurrent": motion.drive_current_a,
            "SteeringCurrent": motion.steering_current_a,
            "DrivePower": round(MOST_PER_MILLE * motion.speed_mps / module.top_speed_mps),
            "SteeringPower": round(MOST_PER_MILLE * motion.steering_share),
        }

    def _health(self, battery_v: float) -> Mapping[str, float]:
        motion, flags = self._module.motion, self._module.flags
        return {
            **{signal: int(flags & bit != 0) for bit, signal in FLAG_SIGNALS.items()},
            "HighestTemperature": round(motion.temperature_c),
            "BatteryCurrent": motion.battery_current_a,
            "BatteryVoltage": battery_v,
        }

    def _identity(self) -> Mapping[str, float]:
        self._identities += 1
        if self._identities % 2 == 0:
            return {"Part": IdentityPart.VERSION, "ModuleType": MODULE_TYPE, **VERSION}
        kept = self._module.kept
        return {
            "Part": IdentityPart.CONSTANTS,
            "HomeSpeed": _as_signed(kept[Parameter.HOME_SPEED], HOME_SPEED_BITS),
            "DriveDirection": _as_signed(kept[Parameter.DRIVE_DIRECTION], DRIVE_DIRECTION_BITS),
            "HomeCount": kept[Parameter.HOME_COUNT],
        }

    def _emergency(self) -> list[Said]:
        flags = self._module.flags
        if flags == self._flags:
            return []
        self._flags = flags
        if Kind.EMERGENCY in self._module.muted:
            return []
        code = 0 if flags & ModuleFlag.HEALTHY.value else self._emergency_code()
        values = {"ErrorRegister": int(code != 0), "FaultFlags": int(self._module.fault_flags), "Detail": 0}
        return [(Kind.EMERGENCY, {"ErrorCode": code, **values})]

    def _emergency_code(self) -> int:
        if self._module.stopped:
            return EXTERNAL_STOP
        return MOTOR_FAULT if self._module.faults else LOW_VOLTAGE


def _as_signed(value: int, bits: int) -> int:
    """What is left of a 32 bit set-up value in the fewer bits of TPDO4."""
    half = 1 << bits - 1
    return (value + half) % (2 * half) - half
