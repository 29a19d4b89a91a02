"""What can go wrong on the robot and what is then done: the one table that the mission reacts by."""

from dataclasses import dataclass
from enum import Enum


class Reaction(Enum):
    """What a fault leads to, from the mildest to the gravest."""

    CONTINUE = "continue"
    SLOW = "slow"
    HOLD = "hold and retry"
    PAUSE = "pause"
    STOP = "stop, recoverable"
    LATCH = "stop, latched"
    MODULES_STOP = "the modules stop by themselves"


class FaultKind(Enum):
    """A fault; the value is how the journal and the operator's terminal call it."""

    CAMERA_FROZEN = "camera frozen"
    CAMERA_BLACK = "camera black"
    CAMERA_WHITE = "camera white"
    CAMERA_UNPLUGGED = "camera unplugged"
    CAMERA_SLOW = "camera slow"
    CAMERA_SIZE = "camera of the wrong size"
    CAMERA_TURNED = "camera upside down"
    CAMERA_BLIND = "camera cannot show crop"
    CAMERA_PAST = "camera shows the past"
    FRAMES_LATE = "frames late"
    MODULE_LATE = "module late"
    MODULE_SILENT = "module silent"
    MODULE_REBOOTED = "module rebooted"
    EMERGENCY_STOP = "emergency stop pressed"
    MODULE_FAILED = "module failed"
    MODULE_UNHEALTHY = "module unhealthy"
    MODULE_MODE = "module not in drive mode"
    MODULE_OTHER = "module not as in the robot file"
    STEERING_STUCK = "steering stuck"
    DRIVE_RUNAWAY = "drive runs away"
    DRIVE_WEAK = "drive does not follow"
    BUS_OFF = "bus off"
    BUS_FLOODED = "bus flooded"
    BUS_GARBLED = "bus garbled"
    FOREIGN_COMMAND = "foreign command"
    BATTERY_FLAT = "battery flat"
    WALL_CLOCK = "wall clock jumped"
    LOOP_LATE = "loop late"
    DISK_FULL = "disk full"
    STANDS_STILL = "wheels stand still"
    PROGRAM = "error in the program"
    PROCESS_KILLED = "process killed"


@dataclass(frozen=True, slots=True)
class Declared:
    """A fault's reaction, how it is noticed, and what a person should then look at."""

    reaction: Reaction
    noticed: str
    advice: str


FAULTS: dict[FaultKind, Declared] = {
    FaultKind.CAMERA_FROZEN: Declared(
        Reaction.HOLD,
        "the same picture again although the wheels have moved, or for 5 s",
        "replug the camera",
    ),
    FaultKind.CAMERA_BLACK: Declared(
        Reaction.HOLD, "hardly any light in the picture", "look for a cap, a cable, the night"
    ),
    FaultKind.CAMERA_WHITE: Declared(
        Reaction.HOLD, "nearly all of the picture is saturated", "shade the lens, set the exposure"
    ),
    FaultKind.CAMERA_UNPLUGGED: Declared(
        Reaction.HOLD, "the source cannot be opened or read, or a frame is damaged", "plug it in"
    ),
    FaultKind.CAMERA_SLOW: Declared(
        Reaction.SLOW, "frames come at less than half of their rate", "more light, a faster port"
    ),
    FaultKind.CAMERA_SIZE: Declared(
        Reaction.LATCH,
        "the picture is not of the robot file's size",
        "set width_px and height_px or the camera right",
    ),
    FaultKind.CAMERA_TURNED: Declared(
        Reaction.LATCH,
        "the ground moves through the picture against what the wheels say",
        "hang it the right way up, or give front and rear their own sources",
    ),
    FaultKind.CAMERA_BLIND: Declared(
        Reaction.HOLD,
        "the picture has no colour or nothing in it, or plants that must be in view are gone",
        "clean the lens, turn the camera's night mode off",
    ),
    FaultKind.CAMERA_PAST: Declared(
        Reaction.STOP,
        "the ground in the pictures stands still, jumps, or moves later than the wheels say; "
        "or they were shown before",
        "restart the camera and what brings its pictures; look for a buffer or a slow network",
    ),
    FaultKind.FRAMES_LATE: Declared(
        Reaction.HOLD,
        "the newest frame is older than timeouts.frame_s",
        "see to the cable and the host's load",
    ),
    FaultKind.MODULE_LATE: Declared(
        Reaction.HOLD, "no motion report for timeouts.motion_s", "see to the bus's load, cable and plugs"
    ),
    FaultKind.MODULE_SILENT: Declared(
        Reaction.LATCH, "nothing of the module for timeouts.module_s", "see to its power and its plug"
    ),
    FaultKind.MODULE_REBOOTED: Declared(
        Reaction.LATCH, "its heartbeat leaves operation", "see to its power; check its homing"
    ),
    FaultKind.EMERGENCY_STOP: Declared(
        Reaction.STOP,
        "a module says power stage off, EMCY 9000 or emergency stop (object 2112), however short",
        "see why it was pressed and pull it out; a mission then goes on by resume or reset",
    ),
    FaultKind.MODULE_FAILED: Declared(
        Reaction.STOP,
        "a module says a fault that does not pass by itself: encoder, homing, stall, heat, electronics",
        "see to the module",
    ),
    FaultKind.MODULE_UNHEALTHY: Declared(
        Reaction.HOLD,
        "a module says a fault that may pass by itself: voltage, lost telegrams, an illegal command",
        "read its flags",
    ),
    FaultKind.MODULE_MODE: Declared(
        Reaction.STOP,
        "the mode read back from a module is not drive; drive is set again",
        "find who sets it; then resume",
    ),
    FaultKind.MODULE_OTHER: Declared(
        Reaction.LATCH,
        "a constant read back is not the robot file's",
        "set the module or the robot file right",
    ),
    FaultKind.STEERING_STUCK: Declared(
        Reaction.LATCH,
        "a wheel's angle does not follow its set-point",
        "look for a stone or a stalk",
    ),
    FaultKind.DRIVE_RUNAWAY: Declared(
        Reaction.LATCH,
        "a wheel turns faster than it was told; the controllers' emergency stop is set as well",
        "press the emergency stop; do not drive before the module is mended",
    ),
    FaultKind.DRIVE_WEAK: Declared(
        Reaction.LATCH,
        "a wheel falls behind its set-point, or does not fit what the other wheels do",
        "see to the drive's fuse, motor and brake; free the wheel",
    ),
    FaultKind.BUS_OFF: Declared(
        Reaction.LATCH,
        "a frame cannot be sent or read; the modules' watchdogs stop them",
        "see to the bus",
    ),
    FaultKind.BUS_FLOODED: Declared(
        Reaction.LATCH, "more frames than a healthy bus carries", "find who sends them"
    ),
    FaultKind.BUS_GARBLED: Declared(
        Reaction.LATCH, "a module says again and again what cannot be", "see to cable and termination"
    ),
    FaultKind.FOREIGN_COMMAND: Declared(
        Reaction.PAUSE,
        "a drive or steer command that the host did not send; it is left alone while it lasts",
        "a remote has taken over, or somebody meddles",
    ),
    FaultKind.BATTERY_FLAT: Declared(Reaction.STOP, "its charge is below battery.least_charge", "charge it"),
    FaultKind.WALL_CLOCK: Declared(
        Reaction.CONTINUE, "nothing goes by the wall clock; the journal's stamps are the loop's", "none"
    ),
    FaultKind.LOOP_LATE: Declared(
        Reaction.STOP,
        "two rounds further apart than timeouts.loop_s, one that takes longer, or time that runs backwards",
        "find what else loads the computer",
    ),
    FaultKind.DISK_FULL: Declared(Reaction.LATCH, "the journal cannot be written", "make room on the disk"),
    FaultKind.STANDS_STILL: Declared(
        Reaction.STOP, "told to move for 3 s and every wheel stands", "look for what blocks it"
    ),
    FaultKind.PROGRAM: Declared(
        Reaction.LATCH, "an exception that nobody expected", "keep the run's directory and report it"
    ),
    FaultKind.PROCESS_KILLED: Declared(
        Reaction.MODULES_STOP, "no new sequence number for the modules' watchdog", "run --resume"
    ),
}


@dataclass(frozen=True, slots=True)
class Trouble:
    """A fault that has been noticed, and what was seen of it."""

    fault: FaultKind
    said: str

    @property
    def reaction(self) -> Reaction:
        return FAULTS[self.fault].reaction

    def __str__(self) -> str:
        return f"{self.fault.value}: {self.said}"
