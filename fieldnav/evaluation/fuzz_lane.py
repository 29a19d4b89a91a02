"""Lanes to be followed among bad frames: which frames, how many, and how far off it the robot may come."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import cv2

from drivers.thorvald import ThorvaldWheels
from fieldnav.evaluation.fuzz_bus import three_ends
from fieldnav.evaluation.fuzz_can import Bout, Target
from fieldnav.evaluation.fuzz_targets import COMMANDS, EPOCH, ROBOT, MakeWheels
from fieldnav.evaluation.fuzz_tracking import TrackingMission
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.journal.journal import Journal
from fieldnav.mission.loop import TICK_S
from fieldnav.settings.loading import load_field, load_robot, revised
from fieldnav.settings.robot import Robot

FIELD, FIELDS, LENGTH_M = "demo", 4, 8.0
LIMIT_MPS = 0.6
"""The robot's speed limit, just above the 0.5 m/s of the crop, so that it is put to the test."""
ASIDE_M = 0.1
"""So much further off the lane than without the frames it may come; a stop on the slope costs some of it."""
RATES = (0.02, 0.2, 2.0, 20.0)
"""Frames a tick of 20 ms: from one a second to what a bus of 500 kbit/s hardly carries."""
STOPPING = frozenset(kind + node for kind in (0x080, 0x380, 0x480, 0x580, 0x700) for node in range(1, 5))
LEFT_OUT = (COMMANDS | STOPPING, COMMANDS)
"""What the modules would obey is never thrown: CAN knows no sender, and the host can but notice it.

Without emergencies, health, constants, SDO replies and heartbeats, one of which stops a mission for good, it
goes on for longer among what is left: false words on how fast the wheels turn and where they point.
"""


@contextmanager
def tracking_mission(
    bout: Bout, random: Random, make_wheels: MakeWheels = ThorvaldWheels
) -> Iterator[Target]:
    """A lane to follow; the frames, their rate and the field by the bout's number."""
    turn, place = divmod(bout.index, len(RATES))
    seed, kind = divmod(turn, len(LEFT_OUT))
    seed, left_out = seed % FIELDS, LEFT_OUT[kind]
    with _on_the_lane(seed, make_wheels) as target:
        target.challenge(RATES[place], left_out, furthest_alone_m(seed) + ASIDE_M)
        yield target


@cache
def furthest_alone_m(seed: int) -> float:
    """How far off the lane the same robot comes in the same field with nobody else on the bus."""
    with _on_the_lane(seed, ThorvaldWheels) as target:
        tick = 0
        while not target.over:
            tick += 1
            target.tick(tick * TICK_S)
        return target.furthest_m


@cache
def fuzzed_robot() -> Robot:
    """The robot with small pictures and a low speed limit."""
    robot = smaller(load_robot(ROBOT))
    return revised(robot, {"limits": robot.limits.model_dump(mode="json") | {"speed_mps": LIMIT_MPS}})


@contextmanager
def _on_the_lane(seed: int, make_wheels: MakeWheels) -> Iterator[TrackingMission]:
    cv2.setNumThreads(1)
    field = revised(load_field(FIELD), {"lanes": 1, "length_m": LENGTH_M, "seed": seed})
    with ExitStack() as stack:
        ends = stack.enter_context(three_ends())
        folder = stack.enter_context(TemporaryDirectory(prefix="fieldnav-"))
        journal = stack.enter_context(Journal(Path(folder) / "journal.jsonl", EPOCH))
        yield TrackingMission(ends, fuzzed_robot(), field, journal, make_wheels)
