"""Sidestep.Settling: come to rest centred on the new lane, straight to its rows."""

from math import degrees, radians

from fieldnav.messages import CameraName, Direction, Evidence, Frame, Motion
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.sidestep.lane_entry import Entry, entry
from fieldnav.perception.sidestep.next_lane import NextLane
from fieldnav.perception.sidestep.passing_rows import look_at_m
from states.behaviour import Observation, Sight, Step, Task
from states.clearance import away, nearest_end_m
from states.memory import LaneMemory, SwitchMemory
from states.names import Event
from states.passing import found, lane_evidence, look
from states.sideways import sideways, too_far, way

OFFSET_GAIN_PER_S = 0.8
"""What is left is halved in under a second. Our choice."""
CLOSE = 0.5
"""Of what counts as centred: so near the robot comes before it rests."""
FRAMES_AT_REST = 8
"""The picture shakes while the robot moves, and takes some frames to stand."""
LOST_FRAMES = 30
"""Two seconds without the lane: it was none."""
LONGEST_S = 40.0
"""Half a metre at a crawl, and to come to rest several times."""


class Settling:
    """Moves in proportion to what is left, then rests until the filtered rows say centred and aligned."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._resting = False
        self._rested = self._lost = 0
        self._entered_s: float | None = None
        self._step = Step(sideways(task, 0.0))

    def step(self, seen: Observation) -> Step:
        frame = seen.frames.get(self._direction.trailing)
        switch = self._lane.switching
        moved = way(self._task, switch, seen)
        if self._entered_s is None:
            self._entered_s = seen.now_s
        taken = Evidence("settling takes", seen.now_s - self._entered_s, LONGEST_S, "s")
        if too_far(taken):
            return self._stopped((taken, moved), "the new lane could not be centred in time")
        if too_far(moved):
            return self._stopped((taken, moved), "the new lane could not be centred in the sidestep")
        if frame is None:
            return self._step.continued()
        rows, sight = look(self._task, switch, frame, seen)
        there = found(self._task, self._lane, rows)
        evidence = (*lane_evidence(self._task, self._lane, there), moved)
        if there is None:
            return self._without(switch, evidence, sight)
        self._lost = 0
        self._step = self._settle(frame, switch, there, seen.stopped, evidence, sight)
        return self._step

    def _settle(
        self,
        frame: Frame,
        switch: SwitchMemory,
        there: NextLane,
        stopped: bool,
        evidence: tuple[Evidence, ...],
        sight: Sight,
    ) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        rows = switch.crossing
        assert rows, "Sampling begins the crossing"
        at = entry(rows, there, look_at_m(canopy_plane(camera, crop)))
        share = CLOSE if not self._resting else 1.0
        self._resting = within(at, self._task, share)
        self._rested = self._rested + 1 if self._resting and stopped else 0
        evidence = (
            *evidence,
            *entry_evidence(at, self._task),
            Evidence("frames at rest", self._rested, FRAMES_AT_REST, "frames"),
        )
        if self._resting:
            event = Event.LANE_REACHED if self._rested >= FRAMES_AT_REST else None
            return Step(sideways(self._task, 0.0), event, evidence, sight)
        fastest = crop.speeds.sidestep_mps
        speed_mps = max(-fastest, min(fastest, OFFSET_GAIN_PER_S * at.offset_m))
        ahead_mps, slower = away(self._task, self._direction, nearest_end_m(rows, camera))
        motion = sideways(self._task, slower * speed_mps, at.slope, ahead_mps)
        return Step(motion, None, evidence, sight)

    def _without(self, switch: SwitchMemory, evidence: tuple[Evidence, ...], sight: Sight) -> Step:
        """Wait for the lane to be seen again; it was none if it is not."""
        self._lost += 1
        gone = Evidence("frames without the lane", self._lost, LOST_FRAMES, "frames")
        self._step = Step(sideways(self._task, 0.0), None, (*evidence, gone), sight)
        if self._lost < LOST_FRAMES:
            return self._step
        switch.refused = "the next lane was lost from sight"
        return Step(sideways(self._task, 0.0), Event.LANE_REFUSED, (*evidence, gone), sight, switch.refused)

    def _stopped(self, evidence: tuple[Evidence, ...], reason: str) -> Step:
        return Step(sideways(self._task, 0.0), Event.FAIL, evidence, reason=reason)


def towards(task: Task, direction: Direction, at: Entry, speed_mps: float) -> Motion:
    """Into the lane at a speed along it, correcting the offset and the heading on the way."""
    outward_mps = max(-speed_mps, min(speed_mps, OFFSET_GAIN_PER_S * at.offset_m))
    return sideways(task, outward_mps, at.slope, -direction.sign * speed_mps)


def within(at: Entry, task: Task, share: float = 1.0) -> bool:
    """Whether the robot stands centred and straight within a share of what the profile allows."""
    switching = task.crop.switching
    centred = abs(at.offset_m) <= share * switching.centred_m
    return centred and abs(at.slope) <= share * radians(switching.aligned_deg)


def entry_evidence(at: Entry, task: Task) -> tuple[Evidence, ...]:
    """How the robot stands before the lane, and how surely."""
    switching = task.crop.switching
    return (
        Evidence("distance to the new lane's centre", at.offset_m, switching.centred_m, "m"),
        Evidence("known within", at.offset_sd_m, None, "m"),
        Evidence("angle to the new lane", degrees(at.slope), switching.aligned_deg, "deg"),
        Evidence("angle known within", degrees(at.slope_sd), None, "deg"),
    )
