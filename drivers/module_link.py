"""The host's end of the line to one wheel module: what it last said, and whether it may move."""

from collections import deque
from collections.abc import Mapping
from enum import Enum

from drivers.module_units import speed_from_rpm, steering_from_counts
from drivers.plausibility import plausible
from drivers.thorvald_protocol import (
    FLAG_SIGNALS,
    IdentityPart,
    Kind,
    ModuleFlag,
    NodeState,
    RoboteqObject,
    SdoCommand,
    flag_faults,
)
from drivers.wire_layout import Telegram
from fieldnav.messages import ModuleReport, Wheel
from fieldnav.settings.robot import Module

READ_REPLIES = frozenset(
    {
        SdoCommand.READ_1_BYTE,
        SdoCommand.READ_2_BYTES,
        SdoCommand.READ_3_BYTES,
        SdoCommand.READ_4_BYTES,
    }
)

NODE_STATES = {state.value: state for state in NodeState}
MOST_GARBLED = 5
"""Garbled telegrams of one module within a second; CRC lets hardly ever one through. Our choice."""


class Missing(Enum):
    """What a module must still say before it may move."""

    STATE = "an operational heartbeat"
    CONSTANTS = "its constants (TPDO4)"
    FAULTS = "its fault flags (object 2112)"
    MOTION = "its motion (TPDO1)"


class ModuleLink:
    """One module as the host knows it."""

    def __init__(self, wheel: Wheel, module: Module) -> None:
        self.wheel = wheel
        self.module = module
        self.heard_s = 0.0
        self.silent = False
        self.rebooted = False
        self.version: tuple[int, int, int] | None = None
        self._garbled_s: deque[float] = deque(maxlen=MOST_GARBLED)
        self._emergency_code = 0
        self._speed_mps = 0.0
        self._temperature_c = 0.0
        self._battery_v = 0.0
        self._flags = int(ModuleFlag.HEALTHY)
        self.forget()

    def begin(self, now_s: float) -> None:
        """Start listening afresh."""
        self.forget()
        self.heard_s = now_s
        self.silent = self.rebooted = False
        self._garbled_s.clear()

    def forget(self) -> None:
        """After a lost connection or a reboot nothing that the module once said holds."""
        self.state: NodeState | None = None
        self.steering_rad: float | None = None
        self._moved_s: float | None = None
        self.constants: Mapping[str, float] | None = None
        self.fault_flags: int | None = None

    @property
    def name(self) -> str:
        return f"module {self.wheel.value} (node {self.module.node_id})"

    @property
    def missing(self) -> Missing | None:
        """The first thing that is still to be heard; None once the module may move."""
        if self.state is not NodeState.OPERATIONAL:
            return Missing.STATE
        if self.constants is None:
            return Missing.CONSTANTS
        if self.fault_flags is None:
            return Missing.FAULTS
        return Missing.MOTION if self._moved_s is None else None

    @property
    def report(self) -> ModuleReport | None:
        if self._moved_s is None or self.steering_rad is None:
            return None
        return ModuleReport(
            stamp_s=self._moved_s,
            speed_mps=self._speed_mps,
            steering_rad=self.steering_rad,
            healthy=not flag_faults(self._flags) and self._emergency_code == 0,
            flags=self._flags,
            temperature_c=self._temperature_c,
            battery_v=self._battery_v,
        )

    def garbled(self, now_s: float) -> bool:
        """Whether the module has said again and again what cannot be."""
        return len(self._garbled_s) == MOST_GARBLED and now_s - self._garbled_s[0] <= 1

    def take(self, telegram: Telegram, now_s: float) -> None:
        """Note what the module says; what cannot be, or what a node must not say, is passed over."""
        if not plausible(telegram, self.module):
            self._garbled_s.append(now_s)
            return
        values = telegram.values
        match telegram.kind:
            case Kind.MOTION:
                self._moved_s = now_s
                self._speed_mps = speed_from_rpm(self.module, values["DriveMotorSpeed"])
                self.steering_rad = steering_from_counts(self.module, values["SteeringCounts"])
            case Kind.HEALTH:
                self._take_health(values)
            case Kind.HEARTBEAT:
                self._take_state(int(values["State"]))
            case Kind.IDENTITY if values["Part"] == IdentityPart.CONSTANTS:
                self.constants = values
            case Kind.IDENTITY:
                self.version = tuple(int(values[f"Version{part}"]) for part in ("Major", "Minor", "Patch"))  # type: ignore[assignment]
            case Kind.SDO_REPLY:
                if values["Command"] in READ_REPLIES and values["Index"] == RoboteqObject.FAULT_FLAGS:
                    self.fault_flags = int(values["Value"])
            case Kind.EMERGENCY:
                self._emergency_code = int(values["ErrorCode"])
            case Kind.LOAD:
                pass  # currents are for the log alone
            case _:
                return
        self.heard_s = now_s

    def _take_health(self, values: Mapping[str, float]) -> None:
        self._flags = sum(bit for bit, signal in FLAG_SIGNALS.items() if values[signal])
        self._temperature_c = values["HighestTemperature"]
        self._battery_v = values["BatteryVoltage"]

    def _take_state(self, code: int) -> None:
        state = NODE_STATES.get(code)
        if self.state is NodeState.OPERATIONAL and state is not NodeState.OPERATIONAL:
            self.forget()
            self.rebooted = True
        self.state = state
