"""Sidestep.Settling: come to rest centred on the new lane, straight to its rows."""

from math import degrees, radians

from fieldnav.messages import CameraName, Direction, Evidence, Frame, Motion
from fieldnav.perception.crossing import follow, new_lane_m
from fieldnav.perception.passing_rows import rows_in_image
from fieldnav.perception.plants import find_plants
from states.behaviour import Observation, Sight, Step, Task
from states.memory import LaneMemory, SwitchMemory
from states.names import Event
from states.sideways import sideways, too_far, turned_rad, way

OFFSET_GAIN_PER_S = 0.8
"""What is left is halved in under a second. Our choice."""
FRAMES_CENTRED = 5
LONGEST_S = 40.0
"""Half a metre at a crawl, and to wait for five good frames in a row."""


class Settling:
    """Moves in proportion to what is left, until several frames say centred and aligned."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._centred = 0
        self._entered_s: float | None = None
        self._step = Step(sideways(task, task.crop.speeds.sidestep_mps))

    def step(self, seen: Observation) -> Step:
        frame = seen.frames.get(self._direction.trailing)
        switch = self._lane.switch
        assert switch, "Orienting begins the switch"
        moved = way(self._task, switch, seen)
        if self._entered_s is None:
            self._entered_s = seen.now_s
        taken_s = seen.now_s - self._entered_s
        if taken_s > LONGEST_S:
            evidence = (Evidence("settling takes", taken_s, LONGEST_S, "s"),)
            return Step(Motion(), Event.FAIL, evidence, reason="the new lane could not be centred in time")
        if too_far(moved):
            return Step(
                Motion(), Event.FAIL, (moved,), reason="the new lane could not be centred in the sidestep"
            )
        if frame is None:
            return self._step.continued()
        self._step = self._settle(frame, switch, moved)
        return self._step

    def _settle(self, frame: Frame, switch: SwitchMemory, moved: Evidence) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        centres = find_plants(frame.image, crop.vegetation, camera)
        assert switch.crossing, "Sampling begins the crossing"
        turned = turned_rad(switch, frame.stamp_s, self._step.motion)
        rows = switch.crossing = follow(switch.crossing, centres, crop, camera, turned)
        offset_m = new_lane_m(rows, crop)
        aligned_rad = radians(crop.switching.aligned_deg)
        good = abs(offset_m) < crop.switching.centred_m and abs(rows.slope) < aligned_rad
        self._centred = self._centred + 1 if good else 0
        evidence = (
            Evidence("distance to the new lane's centre", offset_m, crop.switching.centred_m, "m"),
            Evidence("angle to the new lane", degrees(rows.slope), crop.switching.aligned_deg, "deg"),
            Evidence("frames centred", self._centred, FRAMES_CENTRED, "frames"),
            moved,
        )
        fastest = crop.speeds.sidestep_mps
        speed_mps = max(-fastest, min(fastest, OFFSET_GAIN_PER_S * offset_m))
        motion = sideways(self._task, speed_mps, rows.slope)
        event = Event.LANE_CENTRED if self._centred >= FRAMES_CENTRED else None
        return Step(motion, event, evidence, Sight(frame, rows_in_image(rows, crop, camera), centres))
