"""What each frame says of where the lane ends, taken down in the lane's memory."""

from math import hypot

from fieldnav.estimation.lane_end import LaneEndView
from fieldnav.messages import Centres, Direction, Evidence, Frame, RowLine
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.row_end import crop_along_rows
from states.behaviour import Observation, Task
from states.memory import LaneMemory
from states.names import Event

LANE_ENDED = 0.5
"""Probability of an end from which on the robot leaves the lane; it may still come back."""
SURE = 0.97
"""Probability from which on the lane is left for good."""


def driven_m(seen: Observation, direction: Direction, frame: Frame | None = None) -> float:
    """Distance driven in the direction of travel, now or when a frame was taken."""
    here_m = direction.sign * seen.forward_m
    if frame is None:
        return here_m
    then = seen.exposed_at(frame)
    return here_m - hypot(seen.pose.x_m - then.x_m, seen.pose.y_m - then.y_m)


def watch_end(
    lane: LaneMemory,
    frame: Frame,
    centres: Centres,
    rows: tuple[RowLine, ...],
    seen: Observation,
    direction: Direction,
    task: Task,
) -> LaneEndView:
    """Take in the crop along the rows of a frame of either camera."""
    camera = task.cameras[frame.camera]
    near_m, far_m = canopy_plane(camera, task.crop).view_m
    at_m = driven_m(seen, direction, frame)
    if rows:
        ahead_m, weight = crop_along_rows(centres, rows, task.crop, camera)
        if frame.camera is direction.leading:
            lane.end.lead(at_m + ahead_m, weight, (at_m + near_m, at_m + far_m))
        else:
            lane.end.trail(at_m - ahead_m, weight, (at_m - far_m, at_m - near_m))
    return lane.end.judge()


def end_evidence(view: LaneEndView, threshold: float, fires: Event) -> tuple[Evidence, ...]:
    """Both cameras' word on the end of the lane, a condition of an event."""
    return (
        Evidence("probability that the lane has ended", view.probability, threshold, "", fires),
        Evidence("no crop ahead over", view.empty_m, None, "m"),
    )
