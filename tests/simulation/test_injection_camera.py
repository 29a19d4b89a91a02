"""A broken camera does what it is to do and nothing else; mended, it is as before."""

from itertools import pairwise

import numpy as np
import pytest

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import CameraName, Frame
from fieldnav.simulation.injection_camera import CameraFault, FaultyCamera

RATE_HZ = 15.0
LEAF, SOIL = (50, 150, 70), (72, 96, 122)


class Steady:
    """A camera that gives a new picture fifteen times a second: a leaf that wanders over soil."""

    def __init__(self) -> None:
        self._frame: Frame | None = None

    def latest(self, now_s: float) -> Frame | None:
        number = int(now_s * RATE_HZ + 1e-9)
        if number >= 1 and (self._frame is None or self._frame.sequence != number):
            image = np.full((36, 64, 3), SOIL, np.uint8)
            image[5:10, number % 60 : number % 60 + 4] = LEAF
            self._frame = Frame(CameraName.FRONT, number, number / RATE_HZ, image)
        return self._frame

    def close(self) -> None:
        """Nothing to give back."""


def looks(camera: FaultyCamera, from_s: float, seconds: float) -> list[Frame]:
    """The frames that a loop of 50 Hz sees."""
    frames: list[Frame] = []
    for tick in range(round(seconds * 50)):
        frame = camera.latest(from_s + tick * 0.02)
        if frame is not None and (not frames or frame is not frames[-1]):
            frames.append(frame)
    return frames


def broken(fault: CameraFault, measure: float = 0.0) -> tuple[FaultyCamera, Frame]:
    """A camera that has broken at 1 s, and its last good frame."""
    camera = FaultyCamera(CameraName.FRONT, Steady())
    last = looks(camera, 0.0, 1.0)[-1]
    camera.break_by(fault, 1.0, measure=measure)
    return camera, last


def test_a_healthy_camera_gives_what_it_sees() -> None:
    plain, camera = Steady(), FaultyCamera(CameraName.FRONT, Steady())
    for tick in range(100):
        one, other = plain.latest(tick * 0.02), camera.latest(tick * 0.02)
        assert (one is None) == (other is None)
        if one is not None and other is not None:
            assert one.stamp_s == other.stamp_s
            assert np.array_equal(one.image, other.image)


def test_a_frozen_camera_gives_the_same_picture_with_new_stamps() -> None:
    camera, last = broken(CameraFault.FROZEN)
    frames = looks(camera, 1.0, 1.0)
    assert len(frames) > 10
    assert all(np.array_equal(frame.image, last.image) for frame in frames)
    assert len({(frame.sequence, frame.stamp_s) for frame in frames}) == len(frames)


@pytest.mark.parametrize(("fault", "level"), [(CameraFault.BLACK, 0), (CameraFault.WHITE, 255)])
def test_a_black_or_white_camera_shows_that_alone(fault: CameraFault, level: int) -> None:
    camera, _ = broken(fault)
    assert all((frame.image == level).all() for frame in looks(camera, 1.1, 0.5))


def test_a_turned_camera_shows_the_picture_upside_down() -> None:
    camera, _ = broken(CameraFault.TURNED)
    plain, turned = Steady().latest(1.5), camera.latest(1.5)
    assert plain
    assert turned
    assert np.array_equal(turned.image, np.rot90(plain.image, 2))


def test_a_camera_of_the_wrong_size_shows_half_of_it() -> None:
    camera, _ = broken(CameraFault.SIZE)
    frame = camera.latest(1.5)
    assert frame
    assert frame.image.shape == (18, 32, 3)


def test_an_unplugged_camera_raises_and_gives_frames_again_once_mended() -> None:
    camera, _ = broken(CameraFault.UNPLUGGED)
    with pytest.raises(DriverError) as caught:
        camera.latest(1.5)
    assert caught.value.fault is FaultKind.CAMERA_UNPLUGGED
    camera.mend()
    assert looks(camera, 2.0, 0.5)


def test_late_frames_are_older_by_so_much() -> None:
    camera, _ = broken(CameraFault.LATE, 0.8)
    looks(camera, 1.0, 1.0)
    times_s = [2.0 + tick * 0.02 for tick in range(20)]
    ages = [now_s - frame.stamp_s for now_s in times_s if (frame := camera.latest(now_s))]
    assert min(ages) >= 0.8
    assert max(ages) < 0.8 + 2 / RATE_HZ


@pytest.mark.parametrize("rate_hz", [5.0, 3.0])
def test_a_slow_camera_gives_so_many_frames_and_counts_them(rate_hz: float) -> None:
    camera, _ = broken(CameraFault.SLOW, rate_hz)
    frames = looks(camera, 1.1, 3.0)
    assert len(frames) == pytest.approx(3 * rate_hz, abs=2)
    assert {later.sequence - frame.sequence for frame, later in pairwise(frames)} == {1}


def test_a_bare_field_has_no_green_in_it() -> None:
    camera, _ = broken(CameraFault.BARE)
    frame = camera.latest(1.5)
    assert frame
    assert (frame.image[..., 1] <= frame.image[..., 2]).all()


def test_a_fault_passes_by_itself_where_it_was_told_when() -> None:
    camera = FaultyCamera(CameraName.FRONT, Steady())
    camera.break_by(CameraFault.BLACK, 1.0, 2.0)
    assert not looks(camera, 1.5, 0.2)[-1].image.any()
    assert looks(camera, 2.1, 0.2)[-1].image.any()


def test_frames_never_count_backwards_over_a_slow_spell() -> None:
    camera, _ = broken(CameraFault.SLOW, 3.0)
    before = looks(camera, 1.1, 2.0)
    camera.mend()
    sequences = [frame.sequence for frame in before + looks(camera, 3.1, 1.0)]
    assert sequences == sorted(set(sequences))


@pytest.mark.parametrize("fault", [CameraFault.BLACK, CameraFault.WHITE, CameraFault.UNPLUGGED])
def test_what_is_blind_is_no_good_frame(fault: CameraFault) -> None:
    camera, last = broken(fault)
    try:
        looks(camera, 1.1, 0.5)
    except DriverError:
        assert fault is CameraFault.UNPLUGGED
    assert camera.good_s == last.stamp_s
