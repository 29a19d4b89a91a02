"""The default guide: the lane's path in metres, from many frames of both cameras."""

from dataclasses import replace
from math import degrees, pi

import numpy as np
from numpy.typing import NDArray

from fieldnav.control.path_following import follow_path, in_robot_axes
from fieldnav.estimation.lane_path import LanePath
from fieldnav.estimation.sighting import Sighting
from fieldnav.messages import Bound, CameraName, Centres, Direction, Evidence, Floats, Frame, Motion, RowLine
from fieldnav.odometry import Pose
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.follow import scatter_m, widest_m
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.lane import LaneFit, comb_m
from fieldnav.perception.tracking import Feature, feature
from fieldnav.settings.crop import CropProfile
from states.behaviour import Task
from states.guide import Look
from states.names import Event

UNSURE = 2.0
"""A row's strip is wider by so many standard deviations of the lane's place."""
LEAST_SHARE = 0.05
"""Of being crop, of a plant that may as well be a weed."""


class PathGuide:
    """Steers by the robot's offset, heading and curvature at its centre."""

    def __init__(self, task: Task, direction: Direction) -> None:
        self._task, self._direction = task, direction
        self._path: LanePath | None = None
        self.feature: Feature | None = None

    def begin(self, fit: LaneFit, frame: Frame, pose: Pose) -> None:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        _, far_m = canopy_plane(camera, crop).view_m
        scatter = scatter_m(crop)
        # What the trailing camera sees is the same line looked at the other way round.
        offset_m = fit.offset_m if frame.camera is self._direction.leading else -fit.offset_m
        travelling = self._travelling(pose)
        self._path = LanePath(travelling, offset_m, fit.slope, comb_m(crop), scatter, far_m)

    def look(self, frame: Frame, centres: Centres, pose: Pose) -> Look:
        crop, camera = self._task.crop, self._task.cameras[frame.camera]
        plants = on_ground(centres, crop, camera)
        self._known.carry(self._travelling(pose))
        wider = UNSURE * self._known.state(self._known.pose).offset_sd_m
        reach = np.minimum(plants.half_width_m + wider, widest_m(crop))
        ahead = 1 if frame.camera is self._direction.leading else -1
        sighting = Sighting(ahead * plants.position_m, reach, plants.weight)
        row, off_m, _ = self._known.rows_of(sighting)
        sure = _crop_share(row, off_m, sighting, crop)
        counts = self._known.see(replace(sighting, weight=sure * sighting.weight))
        seen = counts >= crop.tracking.fewest_centres
        rows = self.rows(frame.camera, pose)
        self.feature = feature(rows, camera)
        shown = seen if ahead > 0 else seen[::-1]
        lines = tuple(replace(row, confidence=float(now)) for row, now in zip(rows, shown, strict=True))
        return Look(lines, int(seen.sum()))

    def rows(self, camera: CameraName, pose: Pose) -> tuple[RowLine, ...]:
        crop = self._task.crop
        plane = canopy_plane(self._task.cameras[camera], crop)
        ahead = 1 if camera is self._direction.leading else -1
        x = np.array(plane.view_m)
        near, far = ahead * self._known.rows_at(ahead * x, self._travelling(pose))
        slope = (far - near) / (x[1] - x[0])
        lines = [
            plane.row_in_image(float(y - k * x[0]), float(k), 0.0) for y, k in zip(near, slope, strict=True)
        ]
        return tuple(lines[::ahead])

    def motion(self, pose: Pose, speed_mps: float, camera: CameraName) -> Motion:
        state = self._known.state(self._travelling(pose))
        return in_robot_axes(follow_path(state, speed_mps, self._task.crop.control), self._direction.sign)

    def evidence(self, pose: Pose, lost: Event | None = None) -> tuple[Evidence, ...]:
        state, most_m = self._known.state(self._travelling(pose)), self._task.crop.control.most_uncertain_m
        return (
            Evidence("offset from the lane", state.offset_m, None, "m"),
            Evidence("offset uncertain by", state.offset_sd_m, most_m, "m", lost, Bound.ABOVE, alone=True),
            Evidence("heading against the lane", degrees(state.heading_rad), None, "deg"),
            Evidence("curvature of the lane", state.curvature_per_m, None, "1/m"),
            Evidence("pushed sideways", state.sideslip, None, "m/m"),
        )

    def lost(self, pose: Pose) -> str:
        uncertain_m, most_m = self._known.state(self._travelling(pose)).offset_sd_m, self._task.crop.control
        if uncertain_m > most_m.most_uncertain_m:
            return f"without rows the lane's place has become uncertain by {uncertain_m:.2f} m"
        return ""

    @property
    def _known(self) -> LanePath:
        assert self._path, "the lane was found before it is followed"
        return self._path

    def _travelling(self, pose: Pose) -> Pose:
        """The pose with its heading in the direction of travel."""
        return (
            pose if self._direction is Direction.FORWARD else replace(pose, heading_rad=pose.heading_rad + pi)
        )


def _crop_share(row: NDArray[np.int64], off_m: Floats, plants: Sighting, crop: CropProfile) -> Floats:
    """How much of each plant in a row is likely to be crop, shape (m,): weeds stand between the rows, too.

    row, off_m: the row that each belongs to, -1 for none, and how far it stands from the nearest.
    """
    half_m = crop.rows.spacing_m / 2
    by_chance = plants.reach_m / (half_m - plants.reach_m)
    between = float((by_chance * plants.weight)[(row < 0) & (np.abs(off_m) <= half_m)].sum())
    inside = float(plants.weight[row >= 0].sum())
    share = max(LEAST_SHARE, 1 - between / inside) if inside > 0 else 1.0
    alone = np.bincount(row[row >= 0], minlength=crop.rows.per_lane) < crop.tracking.fewest_centres
    return np.where((row >= 0) & ~alone[row], share, LEAST_SHARE)
