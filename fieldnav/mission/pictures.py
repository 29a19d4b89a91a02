"""What happened, to look at: the map of a simulated run and the overlay video."""

from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np

from fieldnav.evaluation.path import PathObserver
from fieldnav.journal.map import RunMap, draw_map
from fieldnav.journal.overlay import OverlayView, OverlayWriter, draw_overlay
from fieldnav.journal.summary import Summary
from fieldnav.messages import Twist
from fieldnav.mission.tick import Tick
from fieldnav.settings.robot import Robot
from fieldnav.simulation.plan import FieldPlan
from states.names import Phase, text

MAP_STEP_M = 0.25
SHOWN_AS = 0.5
"""Size of the video over that of the camera's pictures."""


class OverlayObserver:
    """Draws every frame that guided the robot, with what was made of it."""

    def __init__(self, path: Path, robot: Robot, lanes: int) -> None:
        camera = robot.cameras.front
        size_px = (round(camera.width_px * SHOWN_AS), round(camera.height_px * SHOWN_AS))
        self._lanes, self._skies_px = lanes, robot.cameras.skies_px()
        self._writer = OverlayWriter(path, size_px, camera.rate_hz)

    def watch(self, tick: Tick) -> None:
        sight = tick.step.sight
        if sight is None:
            return
        image = sight.frame.image
        view = OverlayView(
            image=image,
            state=text(tick.state),
            stamp_s=sight.frame.stamp_s,
            camera=sight.frame.camera.value,
            rows=sight.rows,
            centres=sight.centres,
            feature=sight.feature.line(image.shape[1], image.shape[0]) if sight.feature else None,
            command=tick.passed.motion.twist if not tick.passed.motion.hold else Twist(),
            lane=f"lane {tick.lane} of {self._lanes}",
            note=tick.step.reason,
            sky_px=self._skies_px[sight.frame.camera],
        )
        self._writer.write(draw_overlay(view))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._writer.close()


def draw_run(path: Path, plan: FieldPlan, observer: PathObserver, name: str, summary: Summary) -> None:
    """map.png of a simulated run: rows, true path, row ends as judged, rows as counted."""
    driven = observer.path
    xy = driven.xy()
    ends, crossings = [], []
    for index, state in enumerate(driven.states[1:], start=1):
        if Phase.EXIT in state and state != driven.states[index - 1]:
            ends.append(xy[index])
        if driven.rows_passed[index] > driven.rows_passed[index - 1]:
            crossings.append(xy[index])
    lanes, rows = _lines(plan)
    truth = summary.truth
    error = truth.cross_track_cm.mean if truth and truth.cross_track_cm.mean is not None else float("nan")
    figures = (
        f"{summary.lanes.done} of {summary.lanes.total} lanes, {summary.distance_m:.1f} m in "
        f"{summary.duration_s:.0f} s, cross-track error {error:.1f} cm on average, "
        f"{summary.switches.succeeded} of {summary.switches.attempted} switches"
    )
    outcome = "finished" if summary.completed else "not finished"
    draw_map(
        path,
        RunMap(
            path_m=xy,
            states=[text(state) for state in driven.states],
            lanes_m=lanes,
            rows_m=rows,
            row_ends_m=np.reshape(ends, (-1, 2)).astype(float),
            crossings_m=np.reshape(crossings, (-1, 2)).astype(float),
            title=f"{name}: {outcome}",
            figures=figures,
        ),
    )


def _lines(plan: FieldPlan) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """The lanes' middles and the rows as they were sown."""
    lanes, rows = [], []
    for lane in range(plan.lanes):
        first, last = float(plan.s_first_m[lane].min()), float(plan.s_last_m[lane].max())
        s = np.arange(first, last, MAP_STEP_M)
        lanes.append(plan.centreline.position(s, plan.rows.lane_n(lane, s)))
        for row in np.flatnonzero(plan.sown[lane]).tolist():
            s = np.arange(float(plan.s_first_m[lane, row]), float(plan.s_last_m[lane, row]), MAP_STEP_M)
            rows.append(plan.centreline.position(s, plan.rows.row_n(lane, row, s)))
    return lanes, rows
