"""A camera's tilt, height and yaw are read off rows of known spacing."""

from dataclasses import replace
from math import degrees, radians
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.messages import Centres
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.pose.camera_pose import PoseSighting, sight
from fieldnav.perception.pose.pose_estimate import PoseEstimate
from fieldnav.pinhole import Pinhole
from fieldnav.settings.camera import CameraLimits
from fieldnav.settings.crop import CropProfile

LIMITS = CameraLimits()
FRAMES, STEP_M = 50, 0.1


def seen_by(true: Pinhole, plants_m: np.ndarray, crop: CropProfile) -> Centres:
    """The centres of whole plants, as a camera that looks as `true` does sees them."""
    plane = canopy_plane(true, crop)
    position = plane.to_image(plants_m)
    inside = (position > 0).all(axis=1) & (position < [true.width_px, true.height_px]).all(axis=1)
    across = plane.pixels_per_metre(position[inside, 1])
    area = (across * crop.plants.canopy_width_m) ** 2
    return Centres(position[inside], area, position[inside, 1], position[inside, 1])


def turned(plants_m: np.ndarray, yaw_rad: float, about_m: float) -> np.ndarray:
    """The plants as they lie to a camera that stands `about_m` ahead, turned to the left by `yaw_rad`."""
    cosine, sine = np.cos(yaw_rad), np.sin(yaw_rad)
    ahead, left = (plants_m - [about_m, 0]).T
    return np.stack([about_m + cosine * ahead + sine * left, cosine * left - sine * ahead], axis=-1)


def estimate(drawn: SimpleNamespace, true: Pinhole, scatter_m: float, seed: int = 1) -> PoseEstimate:
    """What FRAMES frames, STEP_M apart along one stand, say of a camera that is filed as `drawn.camera`."""
    crop, filed = drawn.beet, drawn.camera
    field = drawn.stand(crop, scatter_m=scatter_m, ahead_m=(0.3, 3 + FRAMES * STEP_M), seed=seed)
    found = PoseEstimate.of_file(filed, crop)
    for frame in range(FRAMES):
        centres = seen_by(true, field - [frame * STEP_M, 0], crop)
        seen = sight(tuple(drawn.rows(crop, filed)), centres, crop, filed)
        assert seen is not None
        found = found.add(seen)
    return found


@given(
    tilt_deg=st.floats(56, 76),
    height_m=st.floats(0.85, 1.15),
    yaw_deg=st.floats(-6, 6),
    per_lane=st.integers(2, 3),
)
def test_rows_in_a_ruler_line_tell_the_pose_exactly(
    drawn: SimpleNamespace, tilt_deg: float, height_m: float, yaw_deg: float, per_lane: int
) -> None:
    crop = drawn.profile(per_lane, 0.4)
    true = replace(drawn.camera, tilt_rad=radians(tilt_deg), height_m=height_m)
    slope = -np.tan(radians(yaw_deg))
    about_m = 1.3
    rows = tuple(drawn.rows(crop, drawn.camera, -about_m * slope, slope))
    plants = turned(drawn.stand(crop, ahead_m=(-1, 5)), radians(yaw_deg), about_m)

    # The slope is exact only where the file's tilt is; see `sight`.
    filed = replace(drawn.camera, tilt_rad=true.tilt_rad)
    seen = sight(rows, seen_by(true, plants, crop), crop, filed)

    assert seen is not None
    above_m = canopy_plane(true, crop).height_m * np.cos(radians(yaw_deg))
    assert seen.plane[0] == pytest.approx(np.sin(true.tilt_rad) / above_m, rel=1e-6)
    assert seen.plane[1] == pytest.approx(np.cos(true.tilt_rad) / above_m, rel=1e-6)
    assert seen.plane[2] == pytest.approx(slope, abs=1e-6)


@pytest.mark.parametrize(("tilt_deg", "height_m"), [(65, 1.0), (57, 1.0), (73, 0.97), (66.5, 1.2)])
def test_frames_along_the_rows_sharpen_the_estimate(
    drawn: SimpleNamespace, tilt_deg: float, height_m: float
) -> None:
    true = replace(drawn.camera, tilt_rad=radians(tilt_deg), height_m=height_m)

    found = estimate(drawn, true, scatter_m=0.01)

    assert degrees(found.tilt_rad) == pytest.approx(tilt_deg, abs=1.2)
    assert found.height_m == pytest.approx(height_m, abs=0.03)
    assert degrees(found.yaw_rad) == pytest.approx(0, abs=0.5)
    assert degrees(found.deviations()[0]) < 1.2, "it knows how well it knows"


def test_a_camera_set_as_filed_is_never_called_knocked(drawn: SimpleNamespace) -> None:
    for seed in range(1, 11):
        assert estimate(drawn, drawn.camera, scatter_m=0.02, seed=seed).knocked(LIMITS) == (), seed


@pytest.mark.parametrize(
    ("tilt_deg", "height_m", "names"), [(73, 1.0, ["tilt"]), (57, 1.0, ["tilt"]), (65, 0.74, ["height"])]
)
def test_what_was_knocked_is_named(
    drawn: SimpleNamespace, tilt_deg: float, height_m: float, names: list[str]
) -> None:
    true = replace(drawn.camera, tilt_rad=radians(tilt_deg), height_m=height_m)

    knocked = estimate(drawn, true, scatter_m=0.01).knocked(LIMITS)

    assert [departure.name for departure in knocked] == names


def test_one_bad_frame_among_many_changes_little(drawn: SimpleNamespace) -> None:
    good = estimate(drawn, drawn.camera, scatter_m=0.01)
    nonsense = PoseSighting(good.plane * [0.3, -1, 1] + [0, 0, 0.5], np.diag([1e-4, 1e-4, 1e-4]))

    after = good.add(nonsense)

    assert abs(degrees(after.tilt_rad - good.tilt_rad)) < 2
    assert abs(after.height_m - good.height_m) < 0.05
    assert after.knocked(LIMITS) == ()


def test_no_frame_at_all_leaves_the_files_values(drawn: SimpleNamespace) -> None:
    filed = PoseEstimate.of_file(drawn.camera, drawn.beet)

    assert filed.tilt_rad == pytest.approx(drawn.camera.tilt_rad)
    assert filed.height_m == pytest.approx(drawn.camera.height_m)
    assert filed.yaw_rad == 0
    assert degrees(filed.deviations()[0]) == pytest.approx(5, abs=0.1)


@pytest.mark.parametrize("rows", [1, 3])
def test_too_few_rows_with_plants_tell_nothing(drawn: SimpleNamespace, rows: int) -> None:
    crop = drawn.beet
    plants = drawn.stand(crop, without=(0, 2))

    seen = sight(
        tuple(drawn.rows(crop, drawn.camera)[:rows]), seen_by(drawn.camera, plants, crop), crop, drawn.camera
    )

    assert seen is None


def test_a_weed_or_two_between_the_rows_are_no_row(drawn: SimpleNamespace) -> None:
    crop = drawn.beet
    one_row = drawn.stand(crop, without=(0, 2))
    plants = np.concatenate([one_row, [[1.2, 0.4], [1.6, 0.3]]])

    seen = sight(
        tuple(drawn.rows(crop, drawn.camera)), seen_by(drawn.camera, plants, crop), crop, drawn.camera
    )

    assert seen is None


def test_a_frame_without_plants_tells_nothing(drawn: SimpleNamespace) -> None:
    none = Centres(np.empty((0, 2)), np.empty(0), np.empty(0), np.empty(0))

    assert sight(tuple(drawn.rows(drawn.beet, drawn.camera)), none, drawn.beet, drawn.camera) is None


def test_plants_all_at_one_height_of_the_picture_tell_nothing_of_the_tilt(drawn: SimpleNamespace) -> None:
    crop = drawn.beet
    plants = np.array([[1.3, place + off] for place in (0.35, 0, -0.35) for off in (-0.01, 0, 0.01)])

    seen = sight(
        tuple(drawn.rows(crop, drawn.camera)), seen_by(drawn.camera, plants, crop), crop, drawn.camera
    )

    assert seen is None or PoseEstimate.of_file(drawn.camera, crop).add(seen).deviations()[0] > radians(4)


def test_a_mirrored_picture_gives_the_opposite_yaw(drawn: SimpleNamespace) -> None:
    crop, camera = drawn.beet, drawn.camera
    plants = turned(drawn.stand(crop, scatter_m=0.01), radians(3), about_m=1.3)
    centres = seen_by(camera, plants, crop)
    position = centres.position_px * [-1, 1] + [2 * camera.centre_x_px, 0]

    one = sight(tuple(drawn.rows(crop, camera)), centres, crop, camera)
    other = sight(tuple(drawn.rows(crop, camera)), replace(centres, position_px=position), crop, camera)

    assert one and other
    np.testing.assert_allclose(other.plane, one.plane * [1, 1, -1], atol=1e-9)
    assert one.plane[2] == pytest.approx(-np.tan(radians(3)), abs=0.02)
