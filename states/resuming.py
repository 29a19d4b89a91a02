"""Resuming: at standstill, look whether what is seen fits the ledger, before a broken-off mission goes on."""

from dataclasses import dataclass, replace
from math import nan

from fieldnav.estimation.lane_end import LaneEnd
from fieldnav.messages import Bound, CameraName, Evidence, Frame
from fieldnav.perception.lane import LaneFit
from fieldnav.perception.perceive import View, find
from states.acquiring import CREEP_LIMIT_M
from states.agreement import Agreement
from states.behaviour import Observation, Sight, Step, Task
from states.drawn_lane import DrawnLane
from states.guide import Guide
from states.guides import guide_for
from states.judgement import first_of, second_opinion
from states.lane_watch import driven_m, watch_end
from states.memory import LaneMemory
from states.names import Event, Follow, Phase
from states.place import Resumption

AGREEING_FRAMES = 4
OTHER_WAY_S = 2.0
"""So long the camera that should see the lane is waited for before the other one's word is taken."""
LONGEST_S = 6.0
"""What was not seen at standstill by then will not be."""
WIDEST_M, STEEPEST = 0.15, 0.2
"""Offset and slope of the lane: a robot that followed it stands within a third of these. Further off somebody
moved it, or what few plants are in view are taken for other rows than they stand in."""


@dataclass(slots=True)
class _Look:
    """What one camera shows of the lane."""

    agreement: Agreement
    lane: LaneFit | None = None
    no_field: bool = False

    def evidence(self, rows: int) -> tuple[Evidence, ...]:
        """Whether half of the rows are there, and the lane lies where following gets over it."""
        lane, fits, at_most = self.lane, Event.PLACE_FITS, Bound.AT_MOST
        offset_m, slope = (lane.offset_m, lane.slope) if lane else (nan, nan)
        return (
            Evidence("rows of the lane in view", lane.rows_seen if lane else 0, rows / 2, "rows", fits),
            Evidence("offset of the lane", offset_m, None, "m"),
            Evidence("lane off the robot's middle by", abs(offset_m), WIDEST_M, "m", fits, at_most),
            Evidence("slope of the lane", slope),
            Evidence("lane turned against the robot by the slope", abs(slope), STEEPEST, "", fits, at_most),
            *self.agreement.evidence(fits),
        )


class ResumingLane:
    """In a lane: ahead or, near its end, behind, its rows must be where the robot can follow them."""

    def __init__(self, task: Task, resumption: Resumption, lane: LaneMemory) -> None:
        self._task, self._direction, self._lane = task, resumption.direction, lane
        ahead, behind = self._direction.leading, self._direction.trailing
        self.cameras: tuple[CameraName, ...] = (ahead, behind)
        self._first = behind if Phase.EXIT in resumption.leaf else ahead
        self._looks = {name: _Look(Agreement(AGREEING_FRAMES)) for name in self.cameras}
        self._drawn = DrawnLane(task, self._direction)
        self._entered_s: float | None = None
        self._judged: tuple[Evidence, ...] = ()
        self._step = Step()

    def step(self, seen: Observation) -> Step:
        self._entered_s = seen.now_s if self._entered_s is None else self._entered_s
        looked_s = seen.now_s - self._entered_s
        looked = Evidence("looked", looked_s, LONGEST_S, "s", Event.FAIL, Bound.ABOVE)
        for frame in seen.frames.values():
            step = self._look(frame, seen, looked_s)
            self._judged = step.evidence
            self._step = replace(step, evidence=(*step.evidence, looked))
            if self._step.event is not None:
                return self._step
        if first_of((looked,), Event.FAIL):
            return Step(event=Event.FAIL, evidence=(*self._judged, looked), reason=self._misfit())
        return self._step if seen.frames else self._step.continued()

    def _look(self, frame: Frame, seen: Observation, looked_s: float) -> Step:
        crop, look = self._task.crop, self._looks[frame.camera]
        found = find(frame.image, crop, self._task.cameras[frame.camera])
        look.lane = lane = found.lane
        look.agreement.add(lane)
        look.no_field = found.no_field
        evidence = (*look.evidence(crop.rows.per_lane), *second_opinion(found), *self._turn(frame, looked_s))
        sight = Sight(frame, lane.rows if lane else found.lines, found.centres)
        event = first_of(evidence, Event.PLACE_FITS)
        if event and lane:
            guide = guide_for(self._task, self._direction)
            guide.begin(lane, frame, seen.exposed_at(frame))
            self._go_on(guide, lane.rows_seen, found, frame, seen)
            where = "ahead" if frame.camera is self._direction.leading else "behind"
            return Step(event=event, evidence=evidence, sight=sight, reason=f"the lane is seen {where}")
        behind = frame.camera is self._first is self._direction.trailing
        if not behind or looked_s <= OTHER_WAY_S:
            return Step(evidence=evidence, sight=sight)
        evidence = (*evidence, self._drawn.evidence(frame, found.centres, seen.exposed_at(frame)))
        event, reason = first_of(evidence, Event.PLACE_FITS), ""
        if event:
            self._go_on(self._drawn.guide, self._drawn.rows_seen, found, frame, seen)
            reason = "plants stand behind where the lane's rows must end"
        return Step(event=event, evidence=evidence, sight=sight, reason=reason)

    def _turn(self, frame: Frame, looked_s: float) -> tuple[Evidence, ...]:
        """The camera that should not see the lane has its turn once the other one was waited for."""
        if frame.camera is self._first:
            return ()
        waited = "waited for the other camera"
        return (Evidence(waited, looked_s, OTHER_WAY_S, "s", Event.PLACE_FITS, Bound.ABOVE),)

    def _go_on(self, guide: Guide, rows_seen: int, found: View, frame: Frame, seen: Observation) -> None:
        """Follow what is seen ahead; leave the lane by what is seen behind."""
        task, direction, lane = self._task, self._direction, self._lane
        begin_m = driven_m(seen, direction) - CREEP_LIMIT_M
        begin_m -= task.cameras[frame.camera].view_m[1]  # the trailing camera looks back
        lane.enter(guide, LaneEnd(task.crop, begin_m, lane.expected_m, lane.from_m))
        lane.counts[rows_seen] += 1
        rows = guide.rows(frame.camera, seen.exposed_at(frame))
        # The crop behind must be known before the one ahead is missed.
        watch_end(lane, frame, found.centres, rows, seen, direction, task)
        ahead = frame.camera is direction.leading
        lane.resumes = (direction, Phase.FOLLOW, Follow.TRACKING) if ahead else (direction, Phase.EXIT)

    def _misfit(self) -> str:
        lanes = [f"{name.value} camera: {_words(look)}" for name, look in self._looks.items()]
        wanted = f"{self._task.crop.rows.per_lane} rows within {WIDEST_M:g} m of the robot's middle"
        return f"what is seen does not fit lane {self._lane.number}: {'; '.join(lanes)}; wanted {wanted}"


def _words(look: _Look) -> str:
    lane = look.lane
    if lane is None:
        return "no field in view" if look.no_field else "no lane"
    return f"{lane.rows_seen} rows, {abs(lane.offset_m):.2f} m off, slope {lane.slope:.2f}"
