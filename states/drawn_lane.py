"""A lane that is drawn where a robot which followed it must still stand, for want of plants to find it by."""

from fieldnav.messages import Centres, Direction, Evidence, Frame
from fieldnav.odometry import Pose
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.lane import LaneFit, comb_m
from fieldnav.perception.row_end import crop_along_rows
from states.behaviour import Task
from states.guides import guide_for
from states.names import Event

FRAMES_FITTING = 6
LEAST_PLANTS = 1.0
"""Whole ones, that the rows must hold in so many frames beyond what would grow in them by chance."""


class DrawnLane:
    """Straight under the robot's middle at first, then corrected by the few plants in its rows.

    At a lane's end two plants of a row may be all that is in view: enough to go on by, not to find it by.
    """

    def __init__(self, task: Task, direction: Direction) -> None:
        self._task = task
        self.guide = guide_for(task, direction)
        self._begun = False
        self._fitting = 0
        self.rows_seen = 0

    def evidence(self, frame: Frame, centres: Centres, pose: Pose) -> Evidence:
        """Take in a frame of the trailing camera: enough of them must show plants in the lane's rows."""
        if not self._begun:
            self._begun = True
            self.guide.begin(self._straight(frame), frame, pose)
        look = self.guide.look(frame, centres, pose)
        self.rows_seen = look.rows_seen
        _, weight = crop_along_rows(centres, look.rows, self._task.crop, self._task.cameras[frame.camera])
        self._fitting += float(weight.sum()) >= LEAST_PLANTS
        name, fits = "frames with plants in the lane's rows", Event.PLACE_FITS
        return Evidence(name, self._fitting, FRAMES_FITTING, "frames", fits, alone=True)

    def _straight(self, frame: Frame) -> LaneFit:
        crop = self._task.crop
        plane = canopy_plane(self._task.cameras[frame.camera], crop)
        rows = tuple(plane.row_in_image(float(y), 0.0, 0.0) for y in comb_m(crop))
        return LaneFit(rows, 0.0, 0.0, 0, crop.rows.spacing_m, 0.0)
