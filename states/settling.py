"""Sidestep.Settling: come to rest centred on the new lane, straight to its rows."""

from math import degrees, radians

from fieldnav.messages import Bound, CameraName, Direction, Evidence, Frame, Motion
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.sidestep.lane_entry import Entry, entry
from fieldnav.perception.sidestep.next_lane import NextLane
from fieldnav.perception.sidestep.passing_rows import look_at_m
from states.behaviour import Observation, Sight, Step, Task
from states.clearance import away, nearest_end_m
from states.judgement import first_of, holds
from states.memory import LaneMemory, SwitchMemory
from states.names import Event
from states.passing import found, lane_evidence, look
from states.sideways import sideways, way

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
        bounds = taken, _ = self._taken(seen), way(self._task, switch, seen, Event.FAIL)
        if first_of(bounds, Event.FAIL):
            reason = f"the new lane could not be centred in {'time' if holds(taken) else 'the sidestep'}"
            return Step(sideways(self._task, 0.0), Event.FAIL, bounds, reason=reason)
        if frame is None:
            return self._step.continued()
        rows, sight = look(self._task, switch, frame, seen)
        there = found(self._task, self._lane, rows)
        self._lost = 0 if there else self._lost + 1
        lost = Evidence("frames without the lane", self._lost, LOST_FRAMES, "frames", Event.LANE_REFUSED)
        evidence = (*lane_evidence(self._task, self._lane, there), lost, *bounds)
        if there is None:
            return self._without(switch, evidence, sight)
        self._step = self._settle(frame, switch, there, seen.stopped, evidence, sight)
        return self._step

    def _taken(self, seen: Observation) -> Evidence:
        if self._entered_s is None:
            self._entered_s = seen.now_s
        taken_s = seen.now_s - self._entered_s
        return Evidence("settling takes", taken_s, LONGEST_S, "s", Event.FAIL, Bound.ABOVE, alone=True)

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
            *entry_evidence(at, self._task, Event.LANE_REACHED),
            Evidence("frames at rest", self._rested, FRAMES_AT_REST, "frames", Event.LANE_REACHED),
        )
        if self._resting:
            event = first_of(evidence, Event.LANE_REACHED)
            return Step(sideways(self._task, 0.0), event, evidence, sight)
        fastest = crop.speeds.sidestep_mps
        speed_mps = max(-fastest, min(fastest, OFFSET_GAIN_PER_S * at.offset_m))
        ahead_mps, slower = away(self._task, self._direction, nearest_end_m(rows, camera))
        motion = sideways(self._task, slower * speed_mps, at.slope, ahead_mps)
        return Step(motion, None, evidence, sight)

    def _without(self, switch: SwitchMemory, evidence: tuple[Evidence, ...], sight: Sight) -> Step:
        """Wait for the lane to be seen again; it was none if it is not."""
        self._step = Step(sideways(self._task, 0.0), None, evidence, sight)
        event = first_of(evidence, Event.LANE_REFUSED)
        if event is None:
            return self._step
        switch.refused = "the next lane was lost from sight"
        return Step(sideways(self._task, 0.0), event, evidence, sight, switch.refused)


def towards(task: Task, direction: Direction, at: Entry, speed_mps: float) -> Motion:
    """Into the lane at a speed along it, correcting the offset and the heading on the way."""
    outward_mps = max(-speed_mps, min(speed_mps, OFFSET_GAIN_PER_S * at.offset_m))
    return sideways(task, outward_mps, at.slope, -direction.sign * speed_mps)


def within(at: Entry, task: Task, share: float = 1.0) -> bool:
    """Whether the robot stands centred and straight within a share of what the profile allows."""
    switching = task.crop.switching
    centred = abs(at.offset_m) <= share * switching.centred_m
    return centred and abs(at.slope) <= share * radians(switching.aligned_deg)


def furthest_off(at: Entry, task: Task) -> float:
    """How far the robot stands off the lane or is turned against it, over what the profile allows."""
    switching = task.crop.switching
    return max(abs(at.offset_m) / switching.centred_m, abs(degrees(at.slope)) / switching.aligned_deg)


def entry_evidence(
    at: Entry, task: Task, centred: Event, share: float = 1.0, sure_deg: float | None = None
) -> tuple[Evidence, ...]:
    """How the robot stands before the lane, and how surely.

    centred: the event for which it must stand within a share of what the profile allows, and, where a limit
    is given, be so sure of the angle.
    """
    most_m, most_deg = share * task.crop.switching.centred_m, share * task.crop.switching.aligned_deg
    angle_deg, sd_deg = degrees(at.slope), degrees(at.slope_sd)
    sure = None if sure_deg is None else centred
    return (
        Evidence("distance to the new lane's centre", at.offset_m, None, "m"),
        Evidence("off the new lane's centre by", abs(at.offset_m), most_m, "m", centred, Bound.AT_MOST),
        Evidence("known within", at.offset_sd_m, None, "m"),
        Evidence("angle to the new lane", angle_deg, None, "deg"),
        Evidence("turned against the new lane by", abs(angle_deg), most_deg, "deg", centred, Bound.AT_MOST),
        Evidence("angle known within", sd_deg, sure_deg, "deg", sure, Bound.AT_MOST),
    )
