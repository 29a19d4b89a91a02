"""The words of the wheel modules' CANopen dialect.

The numbers are those of CiA 301 and of the Roboteq FBL2360; the telegrams' layout is in config/thorvald.dbc.
"""

from enum import IntEnum, IntFlag, StrEnum


class Kind(StrEnum):
    """A telegram's role; the value is its name in the DBC file, there preceded by the module's name."""

    NMT = "NMT"
    HOST_HEARTBEAT = "Host_Heartbeat"
    BATTERY_VOLTAGE = "Battery_Voltage"
    BATTERY_CURRENT = "Battery_Current"
    BATTERY_CHARGE = "Battery_Charge"
    EMERGENCY = "Emergency"
    MOTION = "TPDO1_Motion"
    LOAD = "TPDO2_Load"
    HEALTH = "TPDO3_Health"
    IDENTITY = "TPDO4_Identity"
    DRIVE = "RPDO1_Drive"
    SET_UP = "RPDO2_SetUp"
    MODE = "RPDO3_Mode"
    STEER = "RPDO4_Steer"
    SDO_REPLY = "SDO_Reply"
    SDO_REQUEST = "SDO_Request"
    HEARTBEAT = "Heartbeat"


class NodeState(IntEnum):
    """What a heartbeat says."""

    BOOT = 0x00
    STOPPED = 0x04
    OPERATIONAL = 0x05
    PRE_OPERATIONAL = 0x7F


class NmtCommand(IntEnum):
    """What the host tells a node to become."""

    START = 0x01
    STOP = 0x02
    ENTER_PRE_OPERATIONAL = 0x80
    RESET = 0x81


class SdoCommand(IntEnum):
    """Expedited SDO transfers: the first byte of request and reply."""

    WRITE_1_BYTE = 0x2F
    READ = 0x40
    READ_4_BYTES = 0x43
    READ_3_BYTES = 0x47
    READ_2_BYTES = 0x4B
    READ_1_BYTE = 0x4F
    WRITTEN = 0x60
    ABORT = 0x80


class RoboteqObject(IntEnum):
    """Objects of the motor controller that are worth having over SDO."""

    EMERGENCY_STOP = 0x200C
    EMERGENCY_STOP_RELEASE = 0x200D
    USER_VARIABLE = 0x2106
    FAULT_FLAGS = 0x2112


MODE_VARIABLE = 1
"""Sub-index of USER_VARIABLE under which a module's script tells its drive mode.

The object, which reads the script's integer variables, is sourced. That the script keeps its mode in the
first of them is our choice: no public telegram tells the mode.
"""


class Mode(IntEnum):
    """What RPDO3 asks a module to be."""

    DRIVE = 0
    HOME = 1
    DECOUPLED = 2


class Parameter(IntEnum):
    """What RPDO2 sets; the first three outlive a power cycle."""

    DRIVE_DIRECTION = 1
    HOME_COUNT = 2
    HOME_SPEED = 3
    CYCLE_MOTION = 8
    CYCLE_LOAD = 9
    CYCLE_HEALTH = 10
    CYCLE_IDENTITY = 11


class IdentityPart(IntEnum):
    """Which half of its identity a module tells in TPDO4."""

    CONSTANTS = 1
    VERSION = 2


class ModuleFlag(IntFlag):
    """Flags of TPDO3; all but HEALTHY are faults."""

    HEALTHY = 0x01
    ILLEGAL_COMMAND = 0x02
    HOMING_COUNT_EXCEEDED = 0x04
    STALL = 0x08
    POWER_STAGE_OFF = 0x10
    ALIGNMENT = 0x20
    STEERING_ENCODER = 0x40
    DRIVE_ENCODER = 0x80


FLAG_SIGNALS = {
    ModuleFlag.HEALTHY.value: "ControllerHealthy",
    ModuleFlag.ILLEGAL_COMMAND.value: "IllegalCommand",
    ModuleFlag.HOMING_COUNT_EXCEEDED.value: "HomingCountExceeded",
    ModuleFlag.STALL.value: "Stall",
    ModuleFlag.POWER_STAGE_OFF.value: "PowerStageOff",
    ModuleFlag.ALIGNMENT.value: "AlignmentFault",
    ModuleFlag.STEERING_ENCODER.value: "SteeringEncoderFault",
    ModuleFlag.DRIVE_ENCODER.value: "DriveEncoderFault",
}
"""The DBC file's name of each flag, by the flag's number."""


class FaultFlag(IntFlag):
    """Flags of object 2112."""

    OVERHEAT = 0x01
    OVERVOLTAGE = 0x02
    UNDERVOLTAGE = 0x04
    SHORT_CIRCUIT = 0x08
    EMERGENCY_STOP = 0x10
    SENSOR_OR_SET_UP = 0x20
    MOSFET = 0x40
    DEFAULT_CONFIGURATION = 0x80
