"""Sidestep.Crossing: move sideways and count the new rows (paper III-C)."""

from math import nan

from fieldnav.messages import CameraName, Direction, Evidence, Frame, Motion
from fieldnav.perception.crossing import accept, follow
from fieldnav.perception.passing_rows import Crossing, candidate_row, outermost_row, rows_in_image
from fieldnav.perception.plants import find_plants
from fieldnav.perception.recognition import describe, distance
from states.behaviour import Observation, Sight, Step, Task
from states.memory import LaneMemory, SwitchMemory
from states.names import Event
from states.sideways import sideways, too_far, turned_rad, way

REFRESH_FRAMES = 3
OVERRULING_FRAMES = 15
"""A row that stood beside the known ones for so long, 15 cm of the way, is new whatever it looks like."""


class CrossingRows:
    """Counts rows whose features differ from the outermost one's, until a lane's worth has passed."""

    def __init__(self, task: Task, direction: Direction, lane: LaneMemory) -> None:
        self.cameras: tuple[CameraName, ...] = (direction.trailing,)
        self._task, self._direction, self._lane = task, direction, lane
        self._frames = 0
        self._step = Step(sideways(task, task.crop.speeds.sidestep_mps))

    def step(self, seen: Observation) -> Step:
        frame = seen.frames.get(self._direction.trailing)
        switch = self._lane.switch
        assert switch, "Orienting begins the switch"
        moved = way(self._task, switch, seen)
        if too_far(moved):
            return Step(
                Motion(), Event.FAIL, (moved,), reason="the next lane was not found within the sidestep"
            )
        if frame is None:
            return self._step.continued()
        self._step = self._count(frame, switch, moved)
        return self._step

    def _count(self, frame: Frame, switch: SwitchMemory, moved: Evidence) -> Step:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        centres = find_plants(frame.image, crop.vegetation, camera)
        assert switch.crossing, "Sampling begins the crossing"
        turned = turned_rad(switch, frame.stamp_s, self._step.motion)
        rows = follow(switch.crossing, centres, crop, camera, turned)
        rows, evidence = self._recognise(frame, rows, switch)
        switch.crossing = rows
        wanted = self._lane.rows or crop.rows.per_lane
        evidence = (
            Evidence("new rows passed", rows.passed, wanted, "rows"),
            moved,
            *evidence,
        )
        sight = Sight(frame, rows_in_image(rows, crop, camera), centres)
        motion = sideways(self._task, crop.speeds.sidestep_mps, rows.slope)
        return Step(motion, Event.ROWS_CROSSED if rows.passed >= wanted else None, evidence, sight)

    def _recognise(
        self, frame: Frame, rows: Crossing, switch: SwitchMemory
    ) -> tuple[Crossing, tuple[Evidence, ...]]:
        """Compare the outermost row in view with the stored one: it refreshes that one or replaces it."""
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        candidate = candidate_row(rows, crop, camera)
        self._frames += 1
        if candidate is None and self._frames % REFRESH_FRAMES:
            return rows, ()
        line = candidate or outermost_row(rows, crop, camera)
        if line is None:
            return rows, ()
        features = describe(frame.image, line, crop, camera, 0.0, camera.centre_y_px)
        unlike = (
            distance(switch.reference, features, crop.recognition.match_ratio) if switch.reference else None
        )
        threshold = crop.recognition.new_row_distance
        evidence = (
            Evidence(
                "distance of the outermost row's features", unlike if unlike is not None else nan, threshold
            ),
            Evidence("frames beside the known rows", rows.candidate_frames, OVERRULING_FRAMES, "frames"),
        )
        if candidate is None:
            # Seen 3 cm further on a row is still like itself, 12 cm on no longer surely.
            if unlike is not None and unlike <= threshold:
                switch.reference = features
            return rows, evidence
        # Too few features to compare leaves the word to the row's place, and so does a place held for long.
        is_new = unlike is None or unlike > threshold or rows.candidate_frames >= OVERRULING_FRAMES
        if not is_new:
            return rows, evidence
        switch.reference = features
        return accept(rows, crop), evidence
