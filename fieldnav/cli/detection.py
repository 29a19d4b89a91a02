"""The rows of one picture: with the robot's camera, or with one that the picture itself must tell of."""

from dataclasses import dataclass
from math import atan2, cos, degrees
from time import perf_counter

from fieldnav.cli.pictures import read_picture
from fieldnav.messages import Image, RowLine
from fieldnav.perception.perceive import View, find
from fieldnav.perception.unposed import find_unposed
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, Finding
from fieldnav.settings.loading import revised
from fieldnav.settings.robot import Robot

MILLISECONDS = 1000.0
STRAIGHT_DOWN = 1e-6
"""Cosine of a tilt from which on a camera looks at no horizon."""


@dataclass(frozen=True, slots=True)
class Known:
    """What is known before a picture is seen; None where nothing is. A robot brings a crop with it."""

    crop: CropProfile | None
    robot: Robot | None


@dataclass(frozen=True, slots=True)
class Detection:
    """A picture and what was found in it.

    camera: the robot's at the picture's size, or the one that the rows told of; None when they told of none.
    """

    path: str
    image: Image
    known: Known
    view: View
    camera: Pinhole | None
    milliseconds: float

    @property
    def width_px(self) -> int:
        return int(self.image.shape[1])

    @property
    def height_px(self) -> int:
        return int(self.image.shape[0])

    @property
    def estimated(self) -> bool:
        """Whether the camera is not a robot's but the picture's own."""
        return self.known.robot is None

    @property
    def height_m(self) -> float | None:
        """The camera's height above the ground; without a crop there is no measure of it."""
        return None if self.camera is None or self.known.crop is None else self.camera.height_m

    @property
    def horizon_px(self) -> float | None:
        """The image row of the horizon, negative above the picture; None when the camera has none."""
        camera = self.camera
        if camera is None or cos(camera.tilt_rad) < STRAIGHT_DOWN:
            return None
        return camera.horizon_px

    @property
    def finding(self) -> Finding:
        """How the field-structure signal is made."""
        return self.known.crop.finding if self.known.crop else Finding()

    def angle_deg(self, row: RowLine) -> float:
        """A row's angle from the image's vertical, positive clockwise."""
        return degrees(atan2(row.x_top_px - row.x_bottom_px, self.height_px - 1))


def camera_of(image: Image, path: str, robot: Robot) -> Pinhole:
    """The robot's front camera as if its pictures had this size: the field of view stays.

    Raises SettingsError for a size that no camera has, and for one too tall with the horizon in view.
    """
    size = {"width_px": image.shape[1], "height_px": image.shape[0]}
    return revised(robot.cameras.front, size, path).pinhole()


def check(path: str, known: Known) -> None:
    """Raise SettingsError when the file is no picture that rows can be looked for in."""
    image = read_picture(path)
    if known.robot:
        camera_of(image, path, known.robot)


def detect_rows(path: str, known: Known) -> Detection:
    """Find every row of a picture; the time is that of the finding alone. Raises SettingsError."""
    image = read_picture(path)
    given = camera_of(image, path, known.robot) if known.robot else None
    started = perf_counter()
    view, camera = _found(image, known.crop, given)
    milliseconds = (perf_counter() - started) * MILLISECONDS
    return Detection(path, image, known, view, camera, milliseconds)


def _found(image: Image, crop: CropProfile | None, camera: Pinhole | None) -> tuple[View, Pinhole | None]:
    if camera is None:
        found = find_unposed(image, crop)
        return found.view, found.camera
    assert crop is not None, "a robot brings a crop with it"
    return find(image, crop, camera, pose_known=False), camera
