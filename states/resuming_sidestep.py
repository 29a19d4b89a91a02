"""Resuming between two lanes: the old lane's rows must stand where the wheels' travel says."""

from dataclasses import replace

from fieldnav.messages import Bound, CameraName, Evidence, Frame
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.lane import comb_m
from fieldnav.perception.perceive import find
from fieldnav.perception.sidestep.meeting import ROW_MASS, all_known
from fieldnav.perception.sidestep.next_lane import LEAST_GAP, old_lane_m
from fieldnav.perception.sidestep.passing_rows import Crossing, begin, look_at_m
from fieldnav.perception.sidestep.row_lines import row_in_view
from fieldnav.perception.sidestep.row_words import LEAST_SHOWN
from states.behaviour import Observation, Step, Task
from states.judgement import first_of
from states.memory import LaneMemory, SwitchMemory
from states.names import Event, Phase, Sidestep
from states.passing import look
from states.place import Resumption
from states.sideways import began_m

FRAMES_FITTING = 6
LONGEST_S = 6.0
HEADING_SD = 0.05
"""Slope of the rows against a robot that was stopped in the middle of a sidestep."""
PLACE_SD_M = 0.08
"""How far the wheels may have run on after the ledger's last word, and what they slip. Our choice."""


class ResumingSidestep:
    """Draws the old lane's rows from the ledger and looks whether plants stand in them."""

    def __init__(self, task: Task, resumption: Resumption, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (resumption.direction.trailing,)
        self._task, self._lane, self._resumption = task, lane, resumption
        self._entered_s: float | None = None
        self._fitting = 0
        self._judged: tuple[Evidence, ...] = ()
        self._step = Step()

    def step(self, seen: Observation) -> Step:
        if self._entered_s is None:
            self._entered_s = seen.now_s
        looked_s = seen.now_s - self._entered_s
        looked = Evidence("looked", looked_s, LONGEST_S, "s", Event.FAIL, Bound.ABOVE)
        if first_of((looked,), Event.FAIL):
            reason = (
                f"what is seen does not fit a sidestep of {abs(self._resumption.moved_m):.2f} m from lane "
                f"{self._lane.number}: no row stands where its rows must be"
            )
            return Step(event=Event.FAIL, evidence=(*self._judged, looked), reason=reason)
        for frame in seen.frames.values():
            step = self._look(frame, seen)
            self._judged = step.evidence
            self._step = replace(step, evidence=(*step.evidence, looked))
            return self._step
        return self._step.continued()

    def _look(self, frame: Frame, seen: Observation) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        if self._lane.switch is None:
            started_m = seen.sideways_m - self._resumption.moved_m
            self._lane.switch = SwitchMemory(started_m, seen.forward_m, crossing=self._drawn(frame), looks=0)
        rows, sight = look(self._task, self._lane.switch, frame, seen)
        old = [row for row in rows.rows if row.of_old_lane and row_in_view(rows, row.across_m, crop, camera)]
        shown = max((row.shown for row in old), default=0.0)
        met = not old and (bool(rows.new) or self._beyond(frame, rows))
        self._fitting += shown > LEAST_SHOWN or met
        outermost = rows.rows[rows.outermost_old].shown > LEAST_SHOWN
        # A robot that has not come away from the old lane has nothing to go back to.
        in_place = outermost or abs(self._resumption.moved_m) < crop.rows.spacing_m / 2
        evidence = (
            Evidence("moved sideways by the ledger", self._resumption.moved_m, None, "m"),
            Evidence("what a row of the old lane shows", shown, LEAST_SHOWN),
            Evidence("frames that fit", self._fitting, FRAMES_FITTING, "frames", Event.PLACE_FITS),
        )
        event = first_of(evidence, Event.PLACE_FITS)
        if event is None:
            return Step(evidence=evidence, sight=sight)
        self._lane.switch.crossing = all_known(rows)
        if outermost:
            self._lane.switch.started_m = began_m(self._task, seen, old_lane_m(rows, crop))
        at = Sidestep.CROSSING if in_place else Sidestep.RETURNING
        self._lane.switch.looks += in_place  # Returning counts the one that follows it
        self._lane.resumes = (self._resumption.direction, Phase.SIDESTEP, at)
        return Step(event=event, evidence=evidence, sight=sight)

    def _beyond(self, frame: Frame, rows: Crossing) -> bool:
        """Whether a row is found where the next lane may be: at rest one is not met beside a heavier one."""
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        plane, outward = canopy_plane(camera, crop), self._task.outward(frame.camera)
        least_m = rows.rows[rows.outermost_old].across_m + LEAST_GAP * crop.rows.spacing_m
        found = (plane.row_on_ground(line) for line in find(frame.image, crop, camera).lines)
        return any(outward * (offset + slope * look_at_m(plane)) > least_m for offset, slope in found)

    def _drawn(self, frame: Frame) -> Crossing:
        """The old lane's rows, as far behind as the robot has moved to the next lane's side."""
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        plane, outward = canopy_plane(camera, crop), self._task.outward(frame.camera)
        moved_m = self._task.side.sign * self._resumption.moved_m
        lines = [plane.row_in_image(float(y) - outward * moved_m, 0.0) for y in comb_m(crop)]
        crossing = begin(lines, HEADING_SD, outward, crop, camera)
        covariance = crossing.covariance.copy()
        covariance[: len(lines), : len(lines)] += PLACE_SD_M**2  # what is off is off for all of them
        # No row need be in view that tells what rows show here: what is met must be no less than one at all.
        return replace(crossing, covariance=covariance, usual_mass=ROW_MASS)
