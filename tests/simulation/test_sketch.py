"""The sketched field: plants where they stand, as much of them as is rendered, and nothing else."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from fieldnav.messages import Floats, Image, Side
from fieldnav.perception.ground_plants import on_ground
from fieldnav.perception.plants import find_plants
from fieldnav.perception.vegetation import vegetation_of
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.plan import FieldPlan, sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.rendering.view import SKY_BGR, View
from fieldnav.simulation.shaking import Attitude, rotation
from fieldnav.simulation.sketch import SketchRenderer

CAMERA = load_robot("bonnbot").cameras.front.pinhole()
NEAR_M = 0.03  # a plant's centre found in the picture against where it stands
FEWEST = 10  # whole plants in a picture of three rows
HEADLAND_X_M = -4.0


def field_of(crop: str, mirrored: bool = False, **changes: Any) -> tuple[FieldSettings, FieldPlan]:
    field = revised(
        load_field("demo"), {"crop": crop, "lanes": 1, "length_m": 10, "mirrored": mirrored} | changes
    )
    return field, sow(field, load_crop(crop), Side.RIGHT)


def view_at(x_m: float, divisor: int = 1, attitude: Attitude | None = None) -> View:
    turned = rotation(attitude or Attitude(), 1, 0.0, CAMERA.tilt_rad)
    position = np.array([x_m, 0.0, CAMERA.height_m])
    size = (CAMERA.width_px // divisor, CAMERA.height_px // divisor)
    return View(*size, CAMERA.focal_px / divisor, position, turned)


def sketched(crop: str, view: View, **changes: Any) -> Image:
    field, plan = field_of(crop, **changes)
    return SketchRenderer(plan, field, load_crop(crop)).render(view, 0.0)


def test_plants_are_found_where_they_stand() -> None:
    crop = load_crop("sugar-beet")
    field, plan = field_of("sugar-beet", weeds={"per_m2": 0}, gaps={"germination": 1.0})
    x_m = 4.0

    picture = SketchRenderer(plan, field, crop).render(view_at(x_m), 0.0)

    camera = replace(CAMERA, forward_m=x_m)  # as if the robot's centre were the field's origin
    found = on_ground(find_plants(picture, crop.vegetation, camera), crop, camera)
    places = found.position_m[found.weight == 1]
    standing = np.stack([plan.plants.x_m, plan.plants.y_m], axis=-1)
    distance = nearest_m(places, standing)
    assert len(distance) >= FEWEST
    assert np.median(distance) < NEAR_M


def nearest_m(places: Floats, standing: Floats) -> Floats:
    apart = np.linalg.norm(places[:, None] - standing[None], axis=-1)
    return np.asarray(apart.min(axis=1))


@pytest.mark.parametrize("crop", ["sugar-beet", "coriander", "winter-wheat"])
def test_as_much_is_green_as_in_the_rendered_field(crop: str) -> None:
    profile = load_crop(crop)
    field, plan = field_of(crop)
    sketch, rendered = SketchRenderer(plan, field, profile), FieldRenderer(plan, field, profile)
    views = [view_at(x_m, 2) for x_m in (2.0, 4.0, 6.0)]

    shares = [
        np.mean([vegetation_of(each.render(view, 0.0), profile.vegetation).mask > 0 for view in views])
        for each in (sketch, rendered)
    ]

    assert shares[0] == pytest.approx(shares[1], rel=0.5)


def test_a_headland_without_weeds_is_plain_soil() -> None:
    field, _ = field_of("sugar-beet")

    picture = sketched("sugar-beet", view_at(HEADLAND_X_M), weeds={"headland_per_m2": 0})

    assert (picture == field.ground.colour_bgr).all()


def test_a_picture_of_half_the_size_shows_the_same() -> None:
    large, small = (sketched("potato", view_at(3.0, divisor)) for divisor in (1, 2))

    apart = np.abs(large[::2, ::2].astype(int) - small) > 0

    assert small.shape == (CAMERA.height_px // 2, CAMERA.width_px // 2, 3)
    assert apart.any(axis=2).mean() < 0.02


def test_a_robot_that_pitches_sees_plants_elsewhere() -> None:
    level, pitched = (
        sketched("sugar-beet", view_at(3.0, 2, Attitude(pitch_rad=each))) for each in (0.0, 0.03)
    )

    assert (level != pitched).any()


def test_the_mirrored_field_seen_in_a_mirror_is_the_plain_one() -> None:
    crop = load_crop("sugar-beet")
    plain, mirrored = (
        SketchRenderer(sow(field, crop, side), field, crop)
        for field, side in (
            (field_of("sugar-beet")[0], Side.RIGHT),
            (field_of("sugar-beet", True)[0], Side.LEFT),
        )
    )
    view = view_at(3.0, 2, Attitude(roll_rad=0.02))

    pictures = plain.render(view, 0.0), mirrored.render(view.mirrored(), 0.0)[:, ::-1]

    assert (pictures[0] != pictures[1]).any(axis=2).mean() < 0.01


@pytest.mark.parametrize("renderer", [SketchRenderer, FieldRenderer])
def test_above_the_horizon_is_sky_and_below_it_none(renderer: type[SketchRenderer | FieldRenderer]) -> None:
    field, plan = field_of("sugar-beet")
    low = replace(CAMERA, tilt_rad=np.radians(15), width_px=640, height_px=360, focal_px=CAMERA.focal_px / 2)
    turned = rotation(Attitude(), 1, 0.0, low.tilt_rad)
    view = View(640, 360, low.focal_px, np.array([2.0, 0.0, low.height_m]), turned, farthest_m=9.0)

    picture = renderer(plan, field, load_crop("sugar-beet")).render(view, 0.0)

    horizon = round(low.horizon_px)
    assert (picture[: horizon - 2] == SKY_BGR).all()
    assert not (picture[horizon + 3 :] == SKY_BGR).all(axis=-1).any()


def test_a_rolled_camera_sees_the_horizon_slant_and_one_that_looks_down_sees_none() -> None:
    rolled = replace(view_at(4.0), rotation=rotation(Attitude(roll_rad=0.1), 1, 0.0, np.radians(15)))

    corners = rolled.sky_px

    assert corners is not None and corners[2, 1] < corners[3, 1], "the right side hangs lower"
    assert view_at(4.0).sky_px is None
    assert replace(rolled, rotation=rotation(Attitude(), 1, 0.0, np.radians(90))).sky_px is None
