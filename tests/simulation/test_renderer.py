"""What the pictures of the field show, held against the pinhole camera's geometry."""

from math import cos, radians, sin

import cv2
import numpy as np
import pytest

from fieldnav.messages import Side
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile, Plants
from fieldnav.settings.crop import Rows as CropRows
from fieldnav.settings.field import FieldSettings, Gaps, Light, Rows, Weeds
from fieldnav.simulation.plan import FieldPlan, sow
from fieldnav.simulation.renderer import FieldRenderer, View

WIDTH, HEIGHT, FOCAL_PX = 640, 360, 465.6
CAMERA_HEIGHT_M, FORWARD_M = 1.0, 0.75
SMALL_BEET = CropProfile(
    name="sugar-beet",
    growth_stage="test",
    rows=CropRows(per_lane=3, spacing_m=0.35),
    plants=Plants(spacing_m=0.3, canopy_width_m=0.1, canopy_height_m=0.03),
    tuned_for="tests",
)


def make_field(**changes: object) -> FieldSettings:
    tidy = {
        "name": "test",
        "crop": "sugar-beet",
        "lanes": 2,
        "length_m": 8.0,
        "seed": 5,
        "rows": Rows(wander_m=0, pass_error_m=0, scatter_m=0),
        "gaps": Gaps(germination=1, row_gaps_per_10m=0),
        "weeds": Weeds(per_m2=0, headland_per_m2=0),
        "wind_mps": 0,
    }
    return FieldSettings.model_validate(tidy | changes)


def look(x: float, y: float, yaw: float, tilt_deg: float = 65.0, scale: float = 1.0) -> View:
    """A camera of a robot at (x, y), built from its axes rather than through Pinhole."""
    tilt = radians(tilt_deg)
    ahead, right = np.array([cos(yaw), sin(yaw), 0]), np.array([sin(yaw), -cos(yaw), 0])
    forward = ahead * cos(tilt) + np.array([0, 0, -sin(tilt)])
    rotation = np.stack([right, np.cross(forward, right), forward], axis=1)
    position = np.array([x, y, CAMERA_HEIGHT_M]) + FORWARD_M * ahead
    return View(round(WIDTH * scale), round(HEIGHT * scale), FOCAL_PX * scale, position, rotation)


def pinhole(tilt_deg: float = 65.0) -> Pinhole:
    return Pinhole(WIDTH, HEIGHT, FOCAL_PX, CAMERA_HEIGHT_M, radians(tilt_deg), FORWARD_M)


def greens(image: np.ndarray) -> np.ndarray:
    """Where leaves are, shape (height, width), bool."""
    blue, green, red = (image[..., channel].astype(int) for channel in range(3))
    return 2 * green - red - blue > 25


def blobs(mask: np.ndarray) -> np.ndarray:
    """Middles of the larger green regions that do not touch the picture's edge, shape (n, 2)."""
    thick = cv2.dilate(mask.astype(np.uint8), np.ones((5, 5), np.uint8))
    _, _, stats, _ = cv2.connectedComponentsWithStats(thick)
    x, y, w, h, area = stats[1:].T
    whole = (x > 2) & (y > 2) & (x + w < mask.shape[1] - 2) & (y + h < mask.shape[0] - 2) & (area > 150)
    return np.stack([x + w / 2, y + h / 2], axis=-1)[whole]


@pytest.fixture(scope="module")
def tidy() -> tuple[FieldPlan, FieldRenderer]:
    field = make_field()
    plan = sow(field, SMALL_BEET, Side.RIGHT)
    return plan, FieldRenderer(plan, field, SMALL_BEET)


@pytest.mark.parametrize(
    ("yaw", "tilt_deg"), [(0.0, 65.0), (0.1, 65.0), (-0.15, 55.0), (0.05, 75.0), (3.1, 65.0)]
)
def test_plants_are_painted_where_the_pinhole_camera_sees_them(tidy, yaw, tilt_deg):
    plan, renderer = tidy
    x, y = 4.0, -0.1
    found = blobs(greens(renderer.render(look(x, y, yaw, tilt_deg), 0.0)))
    away = np.stack([plan.plants.x_m - x, plan.plants.y_m - y], axis=-1)
    turn = np.array([[cos(yaw), sin(yaw)], [-sin(yaw), cos(yaw)]])
    expected = pinhole(tilt_deg).to_image(away @ turn.T)
    distance = np.hypot(*(found[:, None] - expected[None]).transpose(2, 0, 1))
    assert len(found) >= 5
    assert np.nanmin(distance, axis=1).max() < 18  # 4 cm: leaves stand off their stem, unevenly


def test_ground_moves_through_the_picture_as_the_camera_moves(tidy):
    _, renderer = tidy
    bare = -1.1  # between the lanes, where nothing grows
    before, after = (renderer.render(look(x, bare + 0.75, 0.0), 0.0) for x in (3.0, 3.1))
    camera = pinhole()
    ground = np.array([[1.3, -0.5], [1.1, -0.42], [1.2, -0.40]])
    for point in ground:
        old, new = (np.rint(camera.to_image(point - [moved, 0])).astype(int) for moved in (0.0, 0.1))
        patch = before[old[1] - 12 : old[1] + 13, old[0] - 12 : old[0] + 13]
        area = after[new[1] - 30 : new[1] + 31, new[0] - 30 : new[0] + 31]
        score = cv2.matchTemplate(area, patch, cv2.TM_CCOEFF_NORMED)
        at = np.array(np.unravel_index(score.argmax(), score.shape))
        assert score.max() > 0.3
        assert np.abs(at - 18).max() <= 2


def test_the_same_view_gives_the_same_picture_whatever_was_drawn_before():
    field = make_field(weeds=Weeds(per_m2=10), wind_mps=4, length_m=20.0)
    plan = sow(field, SMALL_BEET, Side.RIGHT)
    one, other = (FieldRenderer(plan, field, SMALL_BEET) for _ in range(2))
    for x in range(15):
        other.render(look(float(x), -0.8, 0.4), float(x))
    view = look(5.0, 0.0, 0.02)
    assert np.array_equal(one.render(view, 1.5), other.render(view, 1.5))


def test_a_mirrored_field_gives_the_mirrored_picture_to_the_pixel():
    changes = {"weeds": Weeds(per_m2=10), "wind_mps": 4}
    plain, mirrored = make_field(**changes), make_field(mirrored=True, **changes)
    right = FieldRenderer(sow(plain, SMALL_BEET, Side.RIGHT), plain, SMALL_BEET)
    left = FieldRenderer(sow(mirrored, SMALL_BEET, Side.LEFT), mirrored, SMALL_BEET)
    here, there = look(4.0, -0.3, 0.1), look(4.0, 0.3, -0.1)
    assert np.array_equal(left.render(there, 2.0), right.render(here, 2.0)[:, ::-1])


def test_wind_moves_leaves_and_still_air_does_not():
    def change(wind_mps: float) -> int:
        field = make_field(wind_mps=wind_mps)
        renderer = FieldRenderer(sow(field, SMALL_BEET, Side.RIGHT), field, SMALL_BEET)
        first, second = (renderer.render(look(4.0, 0.0, 0.0), time_s) for time_s in (0.0, 0.4))
        return int((first != second).sum())

    assert change(0.0) == 0
    assert 0 < change(3.0) < change(9.0)


def test_under_a_clear_sky_shadows_fall_away_from_the_sun():
    def darkness(azimuth_deg: float, sunshine: float) -> tuple[float, float]:
        """Mean brightness of the ground just left and just right of the middle row's plants."""
        tall = Plants(spacing_m=0.2, canopy_width_m=0.1, canopy_height_m=0.1)
        beet = SMALL_BEET.model_copy(update={"plants": tall})
        light = Light(sun_elevation_deg=40, sun_azimuth_deg=azimuth_deg, sunshine=sunshine)
        field = make_field(light=light)
        renderer = FieldRenderer(sow(field, beet, Side.RIGHT), field, beet)
        image = renderer.render(look(4.0, 0.0, 0.0), 0.0)
        columns = image.mean(axis=2)
        ground = ~cv2.dilate(greens(image).astype(np.uint8), np.ones((5, 5), np.uint8)).astype(bool)
        left, right = slice(255, 305), slice(335, 385)
        return float(columns[:, left][ground[:, left]].mean()), float(
            columns[:, right][ground[:, right]].mean()
        )

    (left_lit, right_dark), (left_dark, right_lit), overcast = (
        darkness(90, 1),
        darkness(-90, 1),
        darkness(90, 0),
    )
    assert left_lit > left_dark + 2
    assert right_lit > right_dark + 2
    assert abs(overcast[0] - overcast[1]) < 3


def test_bare_soil_has_no_green(tidy):
    _, renderer = tidy
    assert greens(renderer.render(look(12.0, 0.0, 0.0), 0.0)).sum() == 0


@pytest.mark.parametrize("tilt_deg", [15.0, 89.0])
def test_any_tilt_gives_a_picture_even_one_that_sees_the_horizon(tidy, tilt_deg):
    _, renderer = tidy
    image = renderer.render(look(2.0, 0.0, 0.0, tilt_deg, scale=0.5), 0.0)
    assert image.shape == (180, 320, 3)
    assert greens(image).sum() > 100


def test_more_weeds_show_as_more_green():
    def green(per_m2: float) -> int:
        field = make_field(weeds=Weeds(per_m2=per_m2, patches=0))
        renderer = FieldRenderer(sow(field, SMALL_BEET, Side.RIGHT), field, SMALL_BEET)
        return int(greens(renderer.render(look(4.0, 0.0, 0.0), 0.0)).sum())

    assert green(40.0) > 1.2 * green(0.0)
