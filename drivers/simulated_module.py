"""One simulated wheel module: what it obeys, as a CANopen node.

The fault switches (`silent`, `muted`, `steering_stuck`, `blocked`, `drive_share`, `runaway_mps`, `faults`,
`undervoltage`) and `reboot` break a module as real ones break; `button_pressed` is the robot's emergency
stop.
"""

from collections.abc import Mapping

from drivers.module_units import speed_from_per_mille, steering_from_per_mille
from drivers.simulated_motion import ModuleErrors, SimulatedMotion
from drivers.thorvald_protocol import (
    MODE_VARIABLE,
    FaultFlag,
    Kind,
    Mode,
    ModuleFlag,
    NmtCommand,
    NodeState,
    Parameter,
    RoboteqObject,
    SdoCommand,
)
from fieldnav.messages import WheelSetpoint
from fieldnav.settings.robot import Module

WATCHDOG_S = 0.2
"""Without a new RPDO1 sequence number for this long the wheel stops; our choice, the script's is unknown."""

HOME_RAD = 0.0
"""Angle that homing ends at: straight ahead."""

HOME_SPEED = 100
"""Home speed before anybody sets another; its unit is not public."""

NO_SUCH_OBJECT = 0x06020000
"""SDO abort code (CiA 301)."""

HEALTHY = ModuleFlag.HEALTHY.value
ILLEGAL_COMMAND = ModuleFlag.ILLEGAL_COMMAND.value
POWER_STAGE_OFF = ModuleFlag.POWER_STAGE_OFF.value
"""As plain numbers: operations on flag enums cost as much as the rest of a tick."""

MODES = {mode.value: mode for mode in Mode}
PARAMETERS = {parameter.value: parameter for parameter in Parameter}
EMERGENCY_STOPS = (RoboteqObject.EMERGENCY_STOP, RoboteqObject.EMERGENCY_STOP_RELEASE)


class SimulatedModule:
    """A module from power-up on, as its four kinds of masters see it: NMT, process data, SDO, the wheel."""

    def __init__(self, module: Module, errors: ModuleErrors) -> None:
        self.module = module
        self.errors = errors
        self.motion = SimulatedMotion()
        self.kept: dict[Parameter, int] = {
            Parameter.DRIVE_DIRECTION: module.drive_direction,
            Parameter.HOME_COUNT: module.home_count,
            Parameter.HOME_SPEED: HOME_SPEED,
        }
        self.faults = 0
        self.silent = False
        self.muted: frozenset[Kind] = frozenset()  # telegrams that it no longer sends
        self.steering_stuck = self.blocked = False
        self.drive_share = 1.0  # of its speed set-point that it drives, and reports
        self.runaway_mps: float | None = None  # so it drives whatever it is told, but for the emergency stop
        self.emergency_stop = False  # by object 200C
        self.button_pressed = self.undervoltage = False
        self.reboot()

    def reboot(self) -> None:
        """Power off and on: what was commanded is gone, what the module keeps without power stays."""
        self.state = NodeState.BOOT
        self.mode = Mode.DRIVE
        self.cycles_ms: dict[Parameter, int] = {}
        self._sequence: float | None = None
        self._renewed_s = float("-inf")
        self._wanted_mps = 0.0
        self._wanted_rad: float | None = None

    @property
    def stopped(self) -> bool:
        """Whether its motors are off, by the robot's button or by object 200C."""
        return self.button_pressed or self.emergency_stop

    @property
    def flags(self) -> int:
        """TPDO3's flags; a module that has a fault is not healthy, a wrong command alone is no fault."""
        flags = self.faults | POWER_STAGE_OFF if self.stopped else self.faults
        return flags if flags & ~ILLEGAL_COMMAND or self.undervoltage else flags | HEALTHY

    @property
    def fault_flags(self) -> FaultFlag:
        """Object 2112's flags."""
        low = FaultFlag.UNDERVOLTAGE if self.undervoltage else FaultFlag(0)
        return low | FaultFlag.EMERGENCY_STOP if self.stopped else low

    @property
    def truth(self) -> WheelSetpoint:
        """The wheel's true rim speed and angle, which the reports do not show."""
        return WheelSetpoint(
            self.motion.speed_mps * self.errors.speed_factor,
            self.motion.steering_rad + self.errors.steering_zero_rad,
        )

    def advance(self, now_s: float, dt_s: float) -> None:
        """Move for `dt_s` as the newest commands, the watchdog and the mode say."""
        running = self.state is NodeState.OPERATIONAL and not (self.stopped or self.undervoltage)
        driving = running and self.mode is Mode.DRIVE and now_s - self._renewed_s < WATCHDOG_S
        wanted_rad = self._wanted_rad if driving else None
        if running and self.mode is Mode.HOME:
            wanted_rad = HOME_RAD
        wanted_mps = self._wanted_mps * self.drive_share if driving else 0.0
        if self.runaway_mps is not None and not self.stopped:
            wanted_mps = self.runaway_mps
        self.motion.advance(dt_s, wanted_mps, None if self.steering_stuck else wanted_rad)
        if self.blocked:
            self.motion.speed_mps = 0.0

    def obey(self, now_s: float, kind: Kind, values: Mapping[str, float]) -> Mapping[str, float] | None:
        """Act on one telegram; what an SDO request is answered with."""
        if kind is Kind.NMT:
            self._obey_nmt(int(values["Command"]))
        elif kind is Kind.SDO_REQUEST and self.state not in (NodeState.BOOT, NodeState.STOPPED):
            return self._answer({name: int(value) for name, value in values.items()})
        elif self.state is NodeState.OPERATIONAL:
            self._obey_process_data(now_s, kind, values)
        return None

    def _obey_nmt(self, command: int) -> None:
        if command == NmtCommand.RESET:
            self.reboot()
        elif command == NmtCommand.START:
            self.state = NodeState.OPERATIONAL
        elif command == NmtCommand.STOP:
            self.state = NodeState.STOPPED
        elif command == NmtCommand.ENTER_PRE_OPERATIONAL:
            self.state = NodeState.PRE_OPERATIONAL

    def _obey_process_data(self, now_s: float, kind: Kind, values: Mapping[str, float]) -> None:
        if kind is Kind.DRIVE and values["Sequence"] != self._sequence:
            self._sequence, self._renewed_s = values["Sequence"], now_s
            self._wanted_mps = speed_from_per_mille(self.module, values["DriveSpeed"])
        elif kind is Kind.STEER:
            self._wanted_rad = steering_from_per_mille(self.module, values["SteeringAngle"])
        elif kind is Kind.MODE and values["Mode"] == values["ModeRepeated"] and values["Mode"] in MODES:
            self.mode = MODES[int(values["Mode"])]
        elif kind is Kind.SET_UP and values["Parameter"] in PARAMETERS:
            self._set_up(PARAMETERS[int(values["Parameter"])], int(values["Value"]))
        elif kind in (Kind.MODE, Kind.SET_UP):
            self.faults |= ILLEGAL_COMMAND

    def _set_up(self, parameter: Parameter, value: int) -> None:
        if parameter in self.kept:
            self.kept[parameter] = value
        elif value > 0:
            self.cycles_ms[parameter] = value

    def _answer(self, request: Mapping[str, int]) -> Mapping[str, float]:
        command, index, subindex = request["Command"], request["Index"], request["Subindex"]
        reply, data = SdoCommand.ABORT, NO_SUCH_OBJECT
        if command == SdoCommand.READ and index == RoboteqObject.FAULT_FLAGS:
            reply, data = SdoCommand.READ_1_BYTE, int(self.fault_flags)
        elif command == SdoCommand.READ and (index, subindex) == (RoboteqObject.USER_VARIABLE, MODE_VARIABLE):
            reply, data = SdoCommand.READ_4_BYTES, int(self.mode)
        elif command == SdoCommand.WRITE_1_BYTE and index in EMERGENCY_STOPS and request["Value"] == 1:
            self.emergency_stop = index == RoboteqObject.EMERGENCY_STOP
            reply, data = SdoCommand.WRITTEN, 0
        return {"Command": reply, "Index": index, "Subindex": subindex, "Value": data}
