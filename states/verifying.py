"""Sidestep.Verifying: draw near the new lane and see whether it is what it should be, before following."""

from fieldnav.messages import Bound, CameraName, Direction, Evidence, Frame, Motion
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.sidestep.lane_entry import Entry, entry
from fieldnav.perception.sidestep.next_lane import NextLane
from fieldnav.perception.sidestep.passing_rows import Crossing, look_at_m
from states.behaviour import Observation, Sight, Step, Task
from states.clearance import nearest_end_m
from states.judgement import first_of, holds
from states.memory import LaneMemory, SwitchMemory
from states.names import Event
from states.passing import LIKELY, found, lane_evidence, look
from states.settling import entry_evidence, furthest_off, towards
from states.sideways import sideways, way
from states.verdict import verdict

FRAMES_FITTING = 4
FRAMES_LOOKED = 20
"""At rest; a lane that does not fit in so many is refused."""
NEAR_M = 0.1
"""Beyond the camera: from there the rows fill the view."""
NEARING_MPS = 0.1
LONGEST_NEARING_M = 0.4

UNSURE = "which row of the next lane is missing cannot be told"
UNLIKE = "what was found does not look like the next lane"


class Verifying:
    """Draws near straight ahead, rests, and compares what it sees afresh with the rows as they passed."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._from_m: float | None = None
        self._near = False
        self._fitting = self._looked = 0
        self._step = Step(sideways(task, 0.0))

    def step(self, seen: Observation) -> Step:
        if self._from_m is None:
            self._from_m = seen.forward_m
        frame = seen.frames.get(self._direction.trailing)
        switch = self._lane.switching
        if frame is None:
            return self._step.continued()
        rows, sight = look(self._task, switch, frame, seen)
        there = found(self._task, self._lane, rows)
        drawn_m = abs(seen.forward_m - self._from_m)
        nearing = Evidence("drawn near", drawn_m, LONGEST_NEARING_M, "m", bound=Bound.ABOVE)
        evidence = (*lane_evidence(self._task, self._lane, there), nearing, way(self._task, switch, seen))
        end_m = nearest_end_m(rows, self._task.cameras[frame.camera])
        self._near = self._near or there is None or end_m <= NEAR_M or holds(nearing)
        if there and not self._near:
            motion = self._nearing(self._entry(rows, there, frame))
            self._step = Step(motion, None, evidence, sight)
        elif not seen.stopped:
            self._step = Step(sideways(self._task, 0.0), None, evidence, sight)
        else:
            self._step = self._looked_at(frame, switch, there, evidence, sight)
        return self._step

    def _looked_at(
        self,
        frame: Frame,
        switch: SwitchMemory,
        there: NextLane | None,
        evidence: tuple[Evidence, ...],
        sight: Sight,
    ) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        rows = switch.crossing
        assert rows, "Sampling begins the crossing"
        judged = verdict(frame.image, rows, there, crop, camera)
        self._looked += 1
        self._fitting += judged.fits and there is not None and there.probability >= LIKELY
        at = self._entry(rows, there, frame) if there else None
        evidence = (*evidence, *judged.evidence, *self._looks_evidence(at))
        event = first_of(evidence, Event.LANE_VERIFIED, Event.LANE_OFF_CENTRE, Event.LANE_REFUSED)
        if event is not Event.LANE_REFUSED:
            return Step(sideways(self._task, 0.0), event, evidence, sight)
        unsure = there is not None and there.probability < LIKELY
        few = f"{self._fitting} frames fit, {FRAMES_FITTING} are wanted"
        switch.refused = UNSURE if judged.fits and unsure else f"{UNLIKE}: {judged.objection or few}"
        return Step(sideways(self._task, 0.0), event, evidence, sight, switch.refused)

    def _looks_evidence(self, at: Entry | None) -> tuple[Evidence, ...]:
        """Where enough frames fit the lane is taken, or centred again; where they do not it is refused."""
        fitting, verified, off_centre = self._fitting, Event.LANE_VERIFIED, Event.LANE_OFF_CENTRE
        looked = Evidence("frames looked at", self._looked, FRAMES_LOOKED, "frames", Event.LANE_REFUSED)
        if at is None:
            return (Evidence("frames that fit", fitting, FRAMES_FITTING, "frames"), looked)
        off = furthest_off(at, self._task)
        return (
            Evidence("frames that fit", fitting, FRAMES_FITTING, "frames", verified),
            looked,
            *entry_evidence(at, self._task, verified),
            Evidence("frames that fit, centred or not", fitting, FRAMES_FITTING, "frames", off_centre),
            Evidence("furthest off, over what counts as centred", off, 1.0, "", off_centre, Bound.ABOVE),
        )

    def _entry(self, rows: Crossing, there: NextLane, frame: Frame) -> Entry:
        plane = canopy_plane(self._task.cameras[frame.camera], self._task.crop)
        return entry(rows, there, look_at_m(plane))

    def _nearing(self, at: Entry) -> Motion:
        """Towards the rows, correcting on the way what is seen better from near."""
        return towards(self._task, self._direction, at, NEARING_MPS)
