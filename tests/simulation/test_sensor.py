"""What the lens and the sensor do to a picture."""

import numpy as np
import pytest

from fieldnav.settings.field import CameraErrors
from fieldnav.simulation.sensor import Sensor

WIDTH, HEIGHT = 320, 180
FAULTLESS = CameraErrors(noise=0, vignetting=0, exposure_drift=0)


def grey(value: int = 120) -> np.ndarray:
    return np.full((HEIGHT, WIDTH, 3), value, np.uint8)


def sensor(seed: int = 3, mirrored: bool = False, **errors: float) -> Sensor:
    return Sensor(FAULTLESS.model_copy(update=errors), WIDTH, HEIGHT, seed, mirrored)


def test_a_faultless_sensor_at_rest_leaves_an_even_picture_as_it_is():
    assert np.array_equal(sensor().expose(grey(), 7, (0, 0)), grey())


def test_the_picture_is_exposed_in_place():
    image = grey()
    assert sensor(noise=5).expose(image, 0, (3, 0)) is image


def test_noise_has_the_deviation_asked_for_and_no_bias():
    noisy = sensor(noise=6).expose(grey(), 0, (0, 0)).astype(float)
    assert noisy.std() == pytest.approx(6, rel=0.05)
    assert noisy.mean() == pytest.approx(120, abs=0.2)


def test_a_frame_depends_on_seed_and_sequence_alone_whatever_came_before():
    first, second = (sensor(noise=5, exposure_drift=0.2) for _ in range(2))
    in_order = [first.expose(grey(), n, (2, 1)) for n in range(4)]
    backwards = [second.expose(grey(), n, (2, 1)) for n in (3, 2, 1, 0)][::-1]
    assert np.array_equal(in_order, backwards)
    assert not np.array_equal(in_order[0], in_order[1])
    assert not np.array_equal(in_order[0], sensor(seed=4, noise=5).expose(grey(), 0, (2, 1)))


def test_vignetting_darkens_the_corners_and_not_the_middle():
    image = sensor(vignetting=0.4).expose(grey(200), 0, (0, 0))
    assert image[HEIGHT // 2, WIDTH // 2].tolist() == [200, 200, 200]
    assert float(image[0, 0, 0]) == pytest.approx(120, abs=2)


def test_exposure_drifts_slowly_and_within_its_bounds():
    camera = sensor(exposure_drift=0.3)
    gains = np.array([camera.gain(n) for n in range(2000)])
    assert np.abs(gains - 1).max() <= 0.3
    assert np.ptp(gains) > 0.3
    assert np.abs(np.diff(gains)).max() < 0.01
    exposed = camera.expose(grey(), 900, (0, 0))
    assert exposed.mean() == pytest.approx(120 * gains[900], abs=1)


@pytest.mark.parametrize(("motion", "axis"), [((8.0, 0.0), 1), ((0.0, -8.0), 0)])
def test_motion_smears_along_itself_as_far_as_the_motion_and_nowhere_else(motion, axis):
    image = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    image[90, 160] = 250
    image[88:93, 158:163] = 250
    still = sensor().expose(image.copy(), 0, (0, 0)).astype(float)[..., 0]
    moved = sensor().expose(image.copy(), 0, motion).astype(float)[..., 0]

    def spread(picture: np.ndarray, along: int) -> float:
        profile = picture.sum(axis=1 - along)
        at = np.arange(len(profile))
        mean = (profile * at).sum() / profile.sum()
        return float((profile * (at - mean) ** 2).sum() / profile.sum())

    assert spread(moved, axis) - spread(still, axis) == pytest.approx(8**2 / 12, rel=0.25)
    assert spread(moved, 1 - axis) == pytest.approx(spread(still, 1 - axis), rel=0.05)
    assert moved.sum() == pytest.approx(still.sum(), rel=0.05)


def test_the_mirrored_sensor_gives_the_mirrored_picture():
    random = np.random.default_rng(0)
    scene = random.integers(0, 255, (HEIGHT, WIDTH, 3), dtype=np.uint8)
    errors = {"noise": 5.0, "vignetting": 0.3, "exposure_drift": 0.1}
    plain = sensor(**errors).expose(scene.copy(), 11, (5, 3))
    mirrored = sensor(mirrored=True, **errors).expose(scene[:, ::-1].copy(), 11, (-5, 3))
    assert np.array_equal(mirrored, plain[:, ::-1])
