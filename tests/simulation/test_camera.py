"""The simulated cameras see what geometry says, late, and not always."""

from collections.abc import Callable
from dataclasses import replace
from math import asin, atan2, cos, pi, radians, sin, tan
from typing import Any

import numpy as np
import pytest

from fieldnav.messages import CameraName, Side, Wheel, WheelSetpoint
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer, View
from fieldnav.simulation.shaking import Attitude, Shaking, rotation
from fieldnav.simulation.sketch import SketchRenderer

TICK_S = 0.02
Make = Callable[..., Any]
AHEAD = {wheel: WheelSetpoint(0.5, 0.0) for wheel in Wheel}
PINHOLE = load_robot("bonnbot").cameras.front.pinhole()
SEEDS = range(12)
ERRORS = {"tilt_error_deg": 1.5, "height_error_m": 0.03, "focal_error": 0.02, "yaw_error_deg": 0.3}


@pytest.fixture(scope="module")
def renderer() -> FieldRenderer:
    field = revised(load_field("demo"), {"lanes": 1, "length_m": 6})
    crop = load_crop(field.crop)
    return FieldRenderer(sow(field, crop, Side.RIGHT), field, crop)


def departures(view: View, run: Any, name: CameraName) -> dict[str, float]:
    """How far a camera hangs from where its file says, in the units of the field file."""
    ahead = view.rotation[:, 2]
    told = run.robot.cameras.get(name).pinhole()
    gaze_rad = run.world.now.pose.heading_rad + (0.0 if name is CameraName.FRONT else pi)
    yaw_rad = atan2(ahead[1], ahead[0]) - gaze_rad
    return {
        "tilt_error_deg": float(np.degrees(asin(-ahead[2]) - told.tilt_rad)),
        "height_error_m": float(view.position_m[2]) - told.height_m,
        "focal_error": view.focal_px / told.focal_px - 1,
        "yaw_error_deg": float(np.degrees(atan2(sin(yaw_rad), cos(yaw_rad)))),
    }


def seen(view: View, ahead_m: float, left_m: float) -> tuple[float, float]:
    """Where a point of the ground shows in a view, pixels right of and below the picture's middle.

    The point lies so far ahead of the camera and to its left, for a camera that stands over the world's x.
    """
    point = np.array([ahead_m, left_m - view.position_m[1], -view.position_m[2]])
    right, below, depth = view.projection @ point
    return right / depth - (view.width_px - 1) / 2, below / depth - (view.height_px - 1) / 2


@pytest.mark.parametrize("name", CameraName, ids=lambda name: name.value)
@pytest.mark.parametrize(("key", "most"), ERRORS.items())
def test_a_calibration_error_is_drawn_within_its_bounds_and_changes_nothing_else(
    key: str, most: float, name: CameraName, driven: Make, renderer: FieldRenderer
) -> None:
    drawn = []
    for seed in SEEDS:
        run = driven(ready=False, seed=seed, camera_errors={key: most})
        view = SimulatedCamera(name, run.world, renderer).view(run.world.now)
        found = departures(view, run, name)
        drawn.append(found.pop(key))
        assert all(value == pytest.approx(0, abs=1e-9) for value in found.values()), seed

    assert np.abs(drawn).max() <= most
    assert min(drawn) < -most / 3 and max(drawn) > most / 3


def hung(driven: Make, renderer: FieldRenderer, **errors: float) -> tuple[View, dict[str, float]]:
    """The front camera's view of one seed, and how far it hangs from where it should."""
    run = driven(ready=False, seed=4, camera_errors=errors)
    view = SimulatedCamera(CameraName.FRONT, run.world, renderer).view(run.world.now)
    return view, departures(view, run, CameraName.FRONT)


def test_a_camera_whose_tilt_errs_sees_the_ground_moved_by_the_tangent(
    driven: Make, renderer: FieldRenderer
) -> None:
    view, error = hung(driven, renderer, tilt_error_deg=1.5)
    on_axis_m = PINHOLE.height_m / tan(PINHOLE.tilt_rad)

    right_px, below_px = seen(view, on_axis_m, 0.0)

    assert abs(error["tilt_error_deg"]) > 0.1
    assert right_px == pytest.approx(0, abs=1e-6)
    assert below_px == pytest.approx(-PINHOLE.focal_px * tan(radians(error["tilt_error_deg"])), rel=1e-6)


@pytest.mark.parametrize(
    ("key", "most", "scale"),
    [
        ("height_error_m", 0.03, lambda error: PINHOLE.height_m / (PINHOLE.height_m + error)),
        ("focal_error", 0.02, lambda error: 1 + error),
    ],
)
def test_a_camera_that_hangs_too_high_or_whose_focal_length_errs_sees_the_rows_closer_or_farther(
    key: str, most: float, scale: Callable[[float], float], driven: Make, renderer: FieldRenderer
) -> None:
    view, error = hung(driven, renderer, **{key: most})
    on_axis_m = float(view.position_m[2]) / tan(PINHOLE.tilt_rad)

    right_px, _ = seen(view, on_axis_m, -0.35)

    expected_px = 0.35 * PINHOLE.focal_px * sin(PINHOLE.tilt_rad) / PINHOLE.height_m
    assert right_px == pytest.approx(expected_px * scale(error[key]), rel=1e-6)
    assert right_px != pytest.approx(expected_px, rel=1e-3)


def test_a_camera_turned_aside_sees_the_row_ahead_moved_aside(driven: Make, renderer: FieldRenderer) -> None:
    view, error = hung(driven, renderer, yaw_error_deg=0.3)
    yaw_rad = radians(error["yaw_error_deg"])
    on_axis_m = PINHOLE.height_m / tan(PINHOLE.tilt_rad)

    right_px, _ = seen(view, on_axis_m, 0.0)

    depth_m = PINHOLE.height_m / sin(PINHOLE.tilt_rad)
    assert abs(error["yaw_error_deg"]) > 0.02
    assert right_px == pytest.approx(PINHOLE.focal_px * on_axis_m * sin(yaw_rad) / depth_m, rel=1e-3)


def test_the_view_in_a_mirrored_field_is_the_mirrored_view(driven: Make, renderer: FieldRenderer) -> None:
    disturbed = ERRORS | {"shake_deg": 1.0, "bounce_m": 0.02}
    plain, mirrored = (
        driven(ready=False, seed=3, mirrored=mirror, camera_errors=disturbed) for mirror in (False, True)
    )

    one, other = (
        SimulatedCamera(CameraName.REAR, run.world, renderer).view(run.world.now) for run in (plain, mirrored)
    )

    assert np.abs(one.rotation[0, 0]) > 1e-4
    np.testing.assert_allclose(other.rotation, one.mirrored().rotation, atol=1e-12)
    np.testing.assert_allclose(other.position_m, one.mirrored().position_m, atol=1e-12)


@pytest.mark.parametrize("name", CameraName, ids=lambda name: name.value)
@pytest.mark.parametrize("roll_deg", [-2.0, 1.0])
def test_rolling_moves_the_rows_aside_by_the_cameras_height_times_the_tangent(
    name: CameraName, roll_deg: float, driven: Make, renderer: FieldRenderer
) -> None:
    run = driven(ready=False)
    camera, looking = SimulatedCamera(name, run.world, renderer), 1 if name is CameraName.FRONT else -1
    level = camera.view(run.world.now)
    rolled = camera.view(replace(run.world.now, attitude=Attitude(roll_rad=radians(roll_deg))))

    moved_m = PINHOLE.height_m * tan(radians(roll_deg))

    for ahead_m in (0.3, 0.6, 1.0):
        right_px, below_px = seen(rolled, looking * ahead_m, 0.0)
        # The rolled row is the straight image of a row that far to the robot's right.
        near, far = (seen(level, looking * way_m, -moved_m) for way_m in (0.2, 1.2))
        share = (below_px - near[1]) / (far[1] - near[1])
        assert right_px == pytest.approx(near[0] + share * (far[0] - near[0]), rel=1e-6)


def test_a_bounce_raises_the_camera_and_pitching_lowers_the_end_that_goes_down(
    driven: Make, renderer: FieldRenderer
) -> None:
    run = driven(ready=False)
    cameras = [SimulatedCamera(name, run.world, renderer) for name in CameraName]
    now = replace(run.world.now, attitude=Attitude(pitch_rad=0.02, height_m=0.01))

    heights = [float(camera.view(now).position_m[2]) for camera in cameras]

    forward_m = PINHOLE.forward_m
    assert heights == pytest.approx([1.01 - forward_m * sin(0.02), 1.01 + forward_m * sin(0.02)])


@pytest.mark.parametrize("name", CameraName, ids=lambda name: name.value)
@pytest.mark.parametrize("pitch_deg", [-3.0, 0.0, 4.0])
def test_pitching_moves_the_rows_in_the_picture_as_a_tilt_of_the_camera_does(
    name: CameraName, pitch_deg: float
) -> None:
    settings = load_robot("bonnbot").cameras.get(name)
    pinhole = settings.pinhole()
    looking = 1 if name is CameraName.FRONT else -1
    turned = rotation(Attitude(pitch_rad=radians(pitch_deg)), looking, 0.0, pinhole.tilt_rad)
    view = View(
        pinhole.width_px, pinhole.height_px, pinhole.focal_px, np.array([0.0, 0.0, pinhole.height_m]), turned
    )
    ground = np.array([[ahead, left] for ahead in (0.2, 0.5, 0.9) for left in (-0.4, 0.0, 0.3)])

    seen = np.column_stack([ground, np.full(len(ground), -pinhole.height_m)]) @ view.projection.T
    seen = seen[:, :2] / seen[:, 2:]

    tilted = settings.model_copy(
        update={"tilt_deg": settings.tilt_deg + looking * pitch_deg, "distance_m": 0.0}
    )
    np.testing.assert_allclose(seen, tilted.pinhole().to_image(ground), atol=1e-6)


@pytest.mark.parametrize("name", CameraName, ids=lambda name: name.value)
def test_a_robot_whose_left_side_is_up_sees_what_lies_ahead_moved_aside(name: CameraName) -> None:
    pinhole = load_robot("bonnbot").cameras.get(name).pinhole()
    looking = 1 if name is CameraName.FRONT else -1
    turned = rotation(Attitude(roll_rad=0.02), looking, 0.0, pinhole.tilt_rad)
    view = View(pinhole.width_px, pinhole.height_px, pinhole.focal_px, np.array([0.0, 0.0, 1.0]), turned)

    u, _, depth = view.projection @ np.array([0.5, 0.0, -1.0])

    # The ground turns about the camera: to the robot's right, which the rear camera sees on its left.
    assert u / depth - pinhole.centre_x_px == pytest.approx(
        looking * pinhole.focal_px * sin(0.02) / depth, rel=1e-6
    )


def test_a_robot_that_stands_does_not_shake_and_one_that_drives_does_as_set() -> None:
    errors = load_field("demo").camera_errors.model_copy(update={"shake_deg": 1.0, "bounce_m": 0.02})
    shakings = [Shaking(errors, seed, False) for seed in range(30)]

    standing = [shaking.at(stamp_s, 0.0) for shaking in shakings for stamp_s in np.arange(0, 1, 0.1)]
    driving = [shaking.at(stamp_s, 0.5) for shaking in shakings for stamp_s in np.arange(0, 30, 0.1)]

    assert all(each == Attitude() for each in standing)
    for angles in ([each.roll_rad for each in driving], [each.pitch_rad for each in driving]):
        assert np.std(angles) == pytest.approx(radians(1.0), rel=0.1)
    assert max(abs(each.height_m) for each in driving) < 0.03


def small(robot: Robot) -> Robot:
    """A robot whose cameras give small pictures, which are quickly drawn."""
    cameras = {
        name: getattr(robot.cameras, name).model_copy(update={"width_px": 96, "height_px": 54})
        for name in ("front", "rear")
    }
    return robot.model_copy(update={"cameras": robot.cameras.model_copy(update=cameras)})


def test_frames_come_late_and_some_never_as_set(driven: Make) -> None:
    latency_s, lost = 0.11, 0.3
    run = driven(
        small(load_robot("bonnbot")),
        ready=False,
        camera_errors={"latency_s": latency_s, "lost_frames": lost},
    )
    renderer = SketchRenderer(run.plan, run.field, load_crop(run.field.crop))
    cameras = {name: SimulatedCamera(name, run.world, renderer) for name in CameraName}
    arrived: dict[CameraName, list[tuple[int, float, float]]] = {name: [] for name in CameraName}

    def look(now_s: float) -> None:
        for name, camera in cameras.items():
            frame = camera.latest(now_s)
            if frame and (not arrived[name] or arrived[name][-1][0] != frame.sequence):
                arrived[name].append((frame.sequence, frame.stamp_s, now_s))

    run.go(AHEAD, 10.0, look)

    rate_hz = run.robot.cameras.front.rate_hz
    for frames in arrived.values():
        sequence, stamp_s, seen_s = np.array(frames).T
        late_s = seen_s - stamp_s
        assert (late_s >= latency_s - 1e-9).all() and (late_s < latency_s + 2 * TICK_S).all()
        assert len(frames) / sequence[-1] == pytest.approx(1 - lost, abs=0.1)
        np.testing.assert_allclose(np.diff(stamp_s), np.diff(sequence) / rate_hz, atol=0.011)
    assert arrived[CameraName.FRONT][0][1] != arrived[CameraName.REAR][0][1], "they do not expose at once"


def test_the_same_frame_is_given_until_a_newer_one_arrives(driven: Make) -> None:
    run = driven(small(load_robot("bonnbot")))
    camera = SimulatedCamera(
        CameraName.FRONT, run.world, FieldRenderer(run.plan, run.field, load_crop(run.field.crop))
    )

    run.go(AHEAD, 0.5)
    now_s = run.world.now.stamp_s

    assert camera.latest(now_s) is camera.latest(now_s) is not None
