"""Sidestep.Returning: back towards the old lane until a row of it is in place, to look for the next anew."""

from fieldnav.messages import Bound, CameraName, Direction, Evidence
from fieldnav.perception.sidestep.meeting import all_known
from fieldnav.perception.sidestep.next_lane import old_lane_m
from fieldnav.perception.sidestep.row_words import LEAST_SHOWN
from states.behaviour import Observation, Step, Task
from states.clearance import away, nearest_end_m
from states.judgement import first_of
from states.memory import LaneMemory
from states.names import Event
from states.passing import look
from states.sideways import began_m, sideways, way

FRAMES_SEEN = 10
"""The old lane's outermost row must stand wholly in the view with its plants for so long."""


class Returning:
    """Moves back sideways; how often is bounded by the profile, how far by where the sidestep began."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._frames = 0
        self._step = Step(sideways(task, 0.0))

    def step(self, seen: Observation) -> Step:
        frame = seen.frames.get(self._direction.trailing)
        switch, crop = self._lane.switching, self._task.crop
        moved = way(self._task, switch, seen)
        attempts = crop.switching.attempts
        looks = Evidence("looks for the next lane", switch.looks, attempts, "looks", Event.FAIL, alone=True)
        if first_of((looks,), Event.FAIL):
            return self._stopped((looks, moved), f"{switch.refused} (attempt {switch.looks} of {attempts})")
        if frame is None:
            return self._step.continued()
        camera = self._task.cameras[frame.camera]
        rows, sight = look(self._task, switch, frame, seen)
        seen_again = Event.OLD_LANE_SEEN
        in_place = rows.rows[rows.outermost_old].shown > LEAST_SHOWN
        self._frames = self._frames + 1 if in_place else 0
        evidence = (
            looks,
            moved,
            Evidence(
                "to the old lane's middle", moved.value, 0.0, "m", Event.FAIL, Bound.AT_MOST, alone=True
            ),
            Evidence(
                "frames with the old lane's row in place", self._frames, FRAMES_SEEN, "frames", seen_again
            ),
        )
        event = first_of(evidence, Event.OLD_LANE_SEEN, Event.FAIL)
        if event is Event.OLD_LANE_SEEN:
            switch.looks += 1
            switch.started_m = began_m(self._task, seen, old_lane_m(rows, crop))
            switch.crossing = all_known(rows)
            return Step(sideways(self._task, 0.0), event, evidence, sight)
        if event is Event.FAIL:
            return self._stopped(evidence, "the lane that was left is not seen again")
        ahead_mps, share = away(self._task, self._direction, nearest_end_m(rows, camera))
        motion = sideways(self._task, -share * crop.speeds.sidestep_mps, rows.slope, ahead_mps)
        self._step = Step(motion, None, evidence, sight)
        return self._step

    def _stopped(self, evidence: tuple[Evidence, ...], reason: str) -> Step:
        return Step(sideways(self._task, 0.0), Event.FAIL, evidence, reason=reason)
