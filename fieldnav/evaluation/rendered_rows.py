"""The paper's detection protocol on rendered pictures: rows found against the rows as sown (paper IV-B).

The truth is a row's line in the plane through the canopy's middle, not on the soil: there lies the middle of
what a camera sees of a plant, where a person who marks rows in a picture clicks and where perception reports
them. The camera as it truly hung at that moment projects it; perception is told what a calibration would say.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import cos, pi, radians, sin

import numpy as np
from scipy.optimize import linear_sum_assignment

from fieldnav.evaluation.benchmark import Figure, Plan, Progress
from fieldnav.messages import Floats, Image, RowLine, Side
from fieldnav.perception.canopy import VISIBLE_HEIGHT
from fieldnav.perception.perceive import find
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, RowFinder
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.plan import FieldPlan, sow
from fieldnav.simulation.renderer import FieldRenderer, View
from fieldnav.simulation.sensor import Sensor
from fieldnav.simulation.shaking import Shaking, rotation

CROPS = ("beans", "potato", "coriander", "sugar-beet", "lemon-balm")
SIMULATED = ("sim-curved", "sim-large-gaps", "sim-dense-weed")
IMAGES, QUICK_IMAGES = 100, 10  # of each field; the paper had 100
IMAGES_A_SEED = 10  # pictures of one sown field under one sun
LONGEST_FIELD_M = 40.0  # one whole bend of the curved field; more would only cost time
TILT_DEG = (55.0, 75.0)  # paper
WIDEST_OFFSET_M, WIDEST_HEADING_RAD = 0.10, radians(5.0)  # of the robot's centre from its lane; our choice
ELEVATION_DEG, AZIMUTH_DEG = (20.0, 70.0), (-180.0, 180.0)  # of the sun; lower than 20 it is dusk
DRIVE_S, FRAMES = 600.0, 9000  # moments to draw from: ten minutes at 15 frames/s
REACH_M = 3.0  # a picture shows no ground further from the robot's centre
POINT_STEP_M = 0.02  # between the points of a true row
NEAREST_M = 0.1  # along the camera's axis; what lies behind the lens has no place in the picture
FEWEST_PLANTS = 2  # of a row that shows: one plant alone has no direction, neither for an annotator
WIDE_DEG, NARROW_DEG = 11.0, 2.0  # paper's threshold for an orientation, and ours
POSITION_GOAL, WIDE_GOAL, NARROW_GOAL = 98.0, 99.5, 95.0  # per cent
PAPER_POSITION, PAPER_WIDE = 88.1, 88.3  # per cent
PAPER = "the paper, photographs of five real crops together"
PERCENT = 100.0


@dataclass(frozen=True, slots=True)
class Place:
    """Where the robot stands: `s_m` along a lane, left of its middle, turned from the lane's direction."""

    lane: int
    s_m: float
    offset_m: float = 0.0
    turn_rad: float = 0.0


@dataclass(frozen=True, slots=True)
class Shot:
    """A picture, the camera that took it as perception believes it to be, and the rows that show."""

    image: Image
    camera: Pinhole
    truth: tuple[RowLine, ...]


class Scene:
    """A sown field and the front camera over it; `robot` is the name of a shipped robot."""

    def __init__(
        self, field: FieldSettings, crop: CropProfile, plan: FieldPlan, robot: str = "bonnbot"
    ) -> None:
        camera = load_robot(robot).cameras.front.pinhole()
        self.plan, self.camera = plan, camera
        self._errors, self._crop = field.camera_errors, crop
        self._speed_mps = float(crop.speeds.follow_mps)
        self._renderer = FieldRenderer(plan, field, crop)
        self._sensor = Sensor(field.camera_errors, camera.width_px, camera.height_px, field.seed)
        self._shaking = Shaking(field.camera_errors, field.seed, field.mirrored)

    def random_place(self, random: np.random.Generator) -> Place:
        """Somewhere in a lane, looking along it or against it, with rows as far as the camera sees."""
        lane = int(random.integers(self.plan.lanes))
        first_m = float(self.plan.s_first_m[lane].max()) + REACH_M
        last_m = float(self.plan.s_last_m[lane].min()) - REACH_M
        offset, turn = random.uniform(-1, 1, 2) * (WIDEST_OFFSET_M, WIDEST_HEADING_RAD)
        return Place(lane, random.uniform(first_m, last_m), offset, turn + pi * int(random.integers(2)))

    def shoot(self, place: Place, tilt_rad: float, random: np.random.Generator) -> Shot:
        """Take a picture while driving; shaking and the calibration's errors are drawn anew."""
        time_s, sequence = random.uniform(0, DRIVE_S), int(random.integers(FRAMES))
        view = self._view(place, tilt_rad, time_s, random)
        told = replace(self.camera, tilt_rad=tilt_rad)
        across_px = float(told.pixels_per_metre(told.centre_y_px))
        smear_px = self._speed_mps * self._errors.exposure_s * across_px * sin(tilt_rad)
        image = self._sensor.expose(self._renderer.render(view, time_s), sequence, (0.0, smear_px))
        return Shot(image, told, self._rows_in(view, place))

    def _view(self, place: Place, tilt_rad: float, time_s: float, random: np.random.Generator) -> View:
        attitude = self._shaking.at(time_s, self._speed_mps)
        tilt, height, focal = random.uniform(-1, 1, 3)
        n = float(self.plan.rows.lane_n(place.lane, place.s_m))
        middle = self.plan.centreline.position(place.s_m, n)
        lane_rad = float(self.plan.in_lane(place.lane, middle)[2])
        heading = lane_rad + place.turn_rad
        ahead_m = self.camera.forward_m
        x = middle[0] - place.offset_m * sin(lane_rad) + ahead_m * cos(heading)
        y = middle[1] + place.offset_m * cos(lane_rad) + ahead_m * sin(heading)
        z = self.camera.height_m + self._errors.height_error_m * height + attitude.height_m
        position = np.array([x, y, z - ahead_m * sin(attitude.pitch_rad)])
        true_tilt_rad = tilt_rad + radians(self._errors.tilt_error_deg) * tilt
        focal_px = self.camera.focal_px * (1 + self._errors.focal_error * focal)
        turned = rotation(attitude, 1, heading, true_tilt_rad)
        return View(self.camera.width_px, self.camera.height_px, focal_px, position, turned)

    def _rows_in(self, view: View, place: Place) -> tuple[RowLine, ...]:
        """The true lines of those rows of the lane that show."""
        height_m = VISIBLE_HEIGHT * self._crop.plants.canopy_height_m
        s = np.arange(place.s_m - REACH_M, place.s_m + REACH_M, POINT_STEP_M)
        plants, truth = self.plan.plants, []
        for row in range(self.plan.rows_per_lane):
            own = plants.is_crop & (plants.lane == place.lane) & (plants.row == row)
            stems = np.stack([plants.x_m[own], plants.y_m[own]], axis=-1)
            if in_picture(seen_at(view, stems, height_m), view) >= FEWEST_PLANTS:
                line = self.plan.centreline.position(s, self.plan.rows.row_n(place.lane, row, s))
                truth.append(straight_line(seen_at(view, line, height_m), view.height_px))
        return tuple(truth)


def seen_at(view: View, ground_m: Floats, height_m: float) -> Floats:
    """Pixels, shape (k, 2), of those points over world places, shape (n, 2), that lie before the lens."""
    point = np.column_stack([ground_m, np.full(len(ground_m), height_m)]) - view.position_m
    x, y, depth = view.projection @ point.T
    before = depth > NEAREST_M
    return np.stack([x[before] / depth[before], y[before] / depth[before]], axis=-1)


def in_picture(point_px: Floats, view: View) -> int:
    """How many pixels, shape (n, 2), lie within the picture."""
    last = np.array([view.width_px - 1, view.height_px - 1])
    return int(((point_px >= 0) & (point_px <= last)).all(axis=1).sum())


def straight_line(point_px: Floats, height_px: int) -> RowLine:
    """The straight line that fits a curve of pixels, shape (n, 2), best over the picture's height."""
    order = np.argsort(point_px[:, 1])
    y = np.arange(height_px)
    x = np.interp(y, point_px[order, 1], point_px[order, 0])
    slope, top_px = np.polyfit(y, x, 1)
    return RowLine(float(top_px), float(top_px + slope * (height_px - 1)))


def score(truth: Iterable[RowLine], found: Iterable[RowLine], camera: Pinhole) -> Floats:
    """Per true row: position accuracy, and whether its angle is right within WIDE_DEG and NARROW_DEG.

    Shape (rows, 3), per cent. Each row found stands for one true row at most, the pairs being those that lie
    nearest together; a true row left over is missed and scores 0.
    """
    true, near = (
        np.array([(r.x_top_px, r.x_bottom_px) for r in rows]).reshape(-1, 2) for rows in (truth, found)
    )
    scored = np.zeros((len(true), 3))
    apart_px = np.abs(true[:, None] - near[None, :]).mean(axis=-1)
    mine, theirs = linear_sum_assignment(apart_px)
    off_px = np.abs(true[mine, 1] - near[theirs, 1])
    angles = [np.degrees(np.arctan2(ends[:, 0] - ends[:, 1], camera.height_px - 1)) for ends in (true, near)]
    off_deg = np.abs(angles[0][mine] - angles[1][theirs])
    accuracy = (1 - off_px / camera.width_px).clip(0)
    scored[mine] = np.stack([accuracy, off_deg <= WIDE_DEG, off_deg <= NARROW_DEG], axis=-1) * PERCENT
    return scored


def rendered_rows(plan: Plan, progress: Progress) -> list[Figure]:
    """The figures of every crop and simulated field, by each method of finding rows."""
    count = QUICK_IMAGES if plan.quick else IMAGES
    figures = []
    for name in CROPS + SIMULATED:
        figures += field_figures(load_field(name), count, plan.seed, progress)
    return figures


def field_figures(field: FieldSettings, count: int, seed: int, progress: Progress) -> list[Figure]:
    """Three figures of one field for each method, from so many pictures; fields are sown from `seed` on."""
    crop, random = load_crop(field.crop), np.random.default_rng(seed)
    usual = crop.finding.method
    methods = sorted(RowFinder, key=lambda method: method is not usual)
    scores: dict[RowFinder, list[Floats]] = {method: [] for method in methods}
    for image in range(count):
        progress(field.name, image, count)
        if image % IMAGES_A_SEED == 0:
            scene = _sown(field, crop, seed + image // IMAGES_A_SEED, random)
        shot = scene.shoot(scene.random_place(random), radians(random.uniform(*TILT_DEG)), random)
        for method, so_far in scores.items():
            so_far.append(score(shot.truth, lane_found(shot, with_method(crop, method)), shot.camera))
    progress(field.name, count, count)
    figures = []
    for method, scored in scores.items():
        figures += _figures(field.name, np.concatenate(scored), method, usual)
    return figures


def _sown(field: FieldSettings, crop: CropProfile, seed: int, random: np.random.Generator) -> Scene:
    """The field sown from a seed, under a sun of its own."""
    sun = {
        "sun_elevation_deg": random.uniform(*ELEVATION_DEG),
        "sun_azimuth_deg": random.uniform(*AZIMUTH_DEG),
        "sunshine": random.uniform(),
    }
    changes = {"seed": seed, "light": sun, "length_m": min(field.length_m, LONGEST_FIELD_M)}
    changed = revised(field, changes)
    return Scene(changed, crop, sow(changed, crop, Side.RIGHT))


def with_method(crop: CropProfile, method: RowFinder) -> CropProfile:
    """The same profile, finding rows by a method."""
    return crop.model_copy(update={"finding": crop.finding.model_copy(update={"method": method})})


def lane_found(shot: Shot, crop: CropProfile) -> list[RowLine]:
    """The rows of the lane that perception sees in a picture; those it only fills in are none."""
    lane = find(shot.image, crop, shot.camera).lane
    return [row for row in lane.rows if row.confidence > 0] if lane else []


def _figures(name: str, scored: Floats, method: RowFinder, usual: RowFinder) -> list[Figure]:
    """The three figures of a field; the goals are asked of the method that its profile names."""
    asked = method is usual
    case = name if asked else f"{name} ({method.value.replace('_', ' ')})"
    position, wide, narrow = scored.mean(axis=0)
    goals = (POSITION_GOAL, WIDE_GOAL, NARROW_GOAL) if asked else (None, None, None)
    spread = float(scored[:, 0].std())
    return [
        Figure(case, "position accuracy (%)", float(position), spread, goals[0], PAPER_POSITION, PAPER),
        Figure(case, f"rows within {WIDE_DEG:g} degrees (%)", float(wide), None, goals[1], PAPER_WIDE, PAPER),
        Figure(case, f"rows within {NARROW_DEG:g} degrees (%)", float(narrow), None, goals[2]),
    ]
