"""The host's end of the line to one wheel module: what it last said, and whether it may move."""

from collections import deque
from collections.abc import Mapping
from enum import Enum

from drivers.module_faults import EMERGENCY_CLASS, graver, module_trouble
from drivers.module_units import speed_from_rpm, steering_from_counts
from drivers.plausibility import plausible
from drivers.thorvald_protocol import (
    FLAG_SIGNALS,
    MODE_VARIABLE,
    IdentityPart,
    Kind,
    NodeState,
    RoboteqObject,
    SdoCommand,
)
from drivers.wire_layout import Telegram
from fieldnav.faults import FAULTS, FaultKind, Reaction, Trouble
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


MAX_UNANSWERED = 3
"""Questions after which an answer no longer holds; they are asked twice a second. Our choice."""
ERROR_RESET = 0x00FF
"""EMCY codes up to this say that an error has gone (CiA 301); the error register tells of those left."""


class Missing(Enum):
    """What a module must still say before it may move."""

    STATE = "an operational heartbeat"
    CONSTANTS = "its constants (TPDO4)"
    FAULTS = "its fault flags (object 2112)"
    MODE = "its drive mode (object 2106)"
    HEALTH = "its health (TPDO3)"
    MOTION = "its motion (TPDO1)"


ASKED = frozenset({Missing.FAULTS, Missing.MODE})
"""What a module says only when it is asked."""


class ReadBack:
    """An object of the controller that is read again and again; it holds while questions are answered."""

    def __init__(self) -> None:
        self.value: int | None = None
        self.unanswered = 0
        self.told = False
        self._heeded = True

    @property
    def lapsed(self) -> bool:
        """Whether it has been asked for in vain."""
        return self.unanswered > MAX_UNANSWERED

    def asked(self) -> None:
        self._heeded = True
        self.unanswered += 1
        if self.lapsed:
            self.value = None

    def answered(self, value: int) -> None:
        if self._heeded:
            self.value, self.unanswered, self.told = value, 0, True

    def forget(self) -> None:
        self.value, self.unanswered, self.told = None, 0, False

    def disregard(self) -> None:
        """Forget it, and heed no answer until it is asked for again: one may still be on its way."""
        self.forget()
        self._heeded = False


class ModuleLink:
    """One module as the host knows it."""

    def __init__(self, wheel: Wheel, module: Module, asked: frozenset[Missing] = ASKED) -> None:
        """asked: which questions it is put; what it is not asked for is not missing."""
        self.wheel = wheel
        self.module = module
        self.heard_s = 0.0
        self.silent = False
        self.rebooted = False
        self.version: tuple[int, int, int] | None = None
        self.faults, self.mode = ReadBack(), ReadBack()
        self.trouble: Trouble | None = None
        self._asked = asked
        self._untold: Trouble | None = None
        self._judged: object = None
        self._garbled_s: deque[float] = deque(maxlen=MOST_GARBLED)
        self._speed_mps = 0.0
        self._temperature_c = 0.0
        self._battery_v = 0.0
        self.forget()

    def begin(self, now_s: float) -> None:
        """Start listening afresh."""
        self.forget()
        self.heard_s = now_s
        self.silent = self.rebooted = False
        self._untold = None
        self._garbled_s.clear()

    def forget(self) -> None:
        """After a lost connection or a reboot nothing that the module once said holds.

        A node that has booted is free of errors and does not say so (CiA 301, 7.2.7.1).
        """
        self._left_operation()
        self._emergency_codes: dict[int, int] = {}  # the newest of each class
        self._emergency_flags = 0
        self._judge()

    def _left_operation(self) -> None:
        """What must be told anew by a module that stops telling it; its errors it need not repeat."""
        self.state: NodeState | None = None
        self.steering_rad: float | None = None
        self._moved_s: float | None = None
        self.constants: Mapping[str, float] | None = None
        self._flags: int | None = None
        self.faults.forget()
        self.mode.forget()

    @property
    def name(self) -> str:
        return f"module {self.wheel.value} (node {self.module.node_id})"

    @property
    def missing(self) -> Missing | None:
        """The first thing that is still to be heard; None once the module may move."""
        told = (
            (Missing.STATE, self.state is NodeState.OPERATIONAL),
            (Missing.CONSTANTS, self.constants is not None),
            (Missing.FAULTS, self.faults.value is not None or Missing.FAULTS not in self._asked),
            (Missing.MODE, self.mode.value is not None or Missing.MODE not in self._asked),
            (Missing.HEALTH, self._flags is not None),
            (Missing.MOTION, self._moved_s is not None),
        )
        return next((each for each, is_told in told if not is_told), None)

    @property
    def stops(self) -> Trouble | None:
        """What a person must see to before the wheels may move: a stop, a failure, another mode."""
        if self.trouble is not None and _ends_by_hand(self.trouble):
            return self.trouble
        if self.mode.value is None and Missing.MODE in self._asked:
            return Trouble(FaultKind.MODULE_MODE, f"{self.name} has not told {Missing.MODE.value}")
        return None

    @property
    def report(self) -> ModuleReport | None:
        if self._moved_s is None or self.steering_rad is None:
            return None
        return ModuleReport(
            stamp_s=self._moved_s,
            speed_mps=self._speed_mps,
            steering_rad=self.steering_rad,
            trouble=self.trouble,
            temperature_c=self._temperature_c,
            battery_v=self._battery_v,
        )

    def take_untold(self) -> Trouble | None:
        """A stop or a failure that has begun since the last call, also one that is over again."""
        untold, self._untold = self._untold, None
        return untold

    @property
    def unanswered(self) -> str:
        """Which questions it has left unanswered of late, after it had answered them; in words."""
        for missing, read_back in ((Missing.FAULTS, self.faults), (Missing.MODE, self.mode)):
            if read_back.lapsed and read_back.told:
                return f"has left {read_back.unanswered} questions for {missing.value} unanswered"
        return ""

    def excuse(self, over: bool) -> None:
        """Tell nothing of an emergency stop that the host has set itself, unless it lasts when it is over."""
        if over:
            self._untold = self.trouble if _is_stop(self.trouble) else self._untold
        elif _is_stop(self._untold):
            self._untold = None

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
                self._take_reply(values)
            case Kind.EMERGENCY:
                self._take_emergency(int(values["ErrorCode"]), values)
            case Kind.LOAD:
                pass  # currents are for the log alone
            case _:
                return
        self.heard_s = now_s

    def _take_health(self, values: Mapping[str, float]) -> None:
        self._flags = sum(bit for bit, signal in FLAG_SIGNALS.items() if values[signal])
        self._temperature_c = values["HighestTemperature"]
        self._battery_v = values["BatteryVoltage"]
        self._judge()

    def _take_reply(self, values: Mapping[str, float]) -> None:
        if values["Command"] not in READ_REPLIES:
            return
        if values["Index"] == RoboteqObject.FAULT_FLAGS:
            self.faults.answered(int(values["Value"]))
        elif (values["Index"], values["Subindex"]) == (RoboteqObject.USER_VARIABLE, MODE_VARIABLE):
            self.mode.answered(int(values["Value"]))
        self._judge()

    def _take_emergency(self, code: int, values: Mapping[str, float]) -> None:
        """Errors add up until the register says that none is left; a reset does not say of which it is."""
        if code > ERROR_RESET:
            self._emergency_codes[code & EMERGENCY_CLASS] = code
            self._emergency_flags = int(values["FaultFlags"])
        elif not values["ErrorRegister"]:
            self._emergency_codes.clear()
            self._emergency_flags = 0
        self._judge()

    def _take_state(self, code: int) -> None:
        state = NODE_STATES.get(code)
        if self.state is NodeState.OPERATIONAL and state is not NodeState.OPERATIONAL:
            self._left_operation()
            self.rebooted = True
        if state is NodeState.BOOT:
            self.forget()
        self.state = state
        self._judge()

    def _judge(self) -> None:
        """What the newest signs mean; a stop or a failure that begins is told, however soon it is over."""
        fault_flags = (self.faults.value or 0) | self._emergency_flags
        signs = (self._flags, fault_flags, tuple(sorted(self._emergency_codes.values())), self.mode.value)
        if signs == self._judged:
            return
        self._judged = signs
        before, self.trouble = self.trouble, module_trouble(self.name, *signs)
        if self.trouble is None or not _ends_by_hand(self.trouble):
            return
        begins = before is None or before.fault is not self.trouble.fault
        if begins and graver(self.trouble, self._untold):
            self._untold = self.trouble


def _ends_by_hand(trouble: Trouble) -> bool:
    return FAULTS[trouble.fault].reaction is not Reaction.HOLD


def _is_stop(trouble: Trouble | None) -> bool:
    return trouble is not None and trouble.fault is FaultKind.EMERGENCY_STOP
