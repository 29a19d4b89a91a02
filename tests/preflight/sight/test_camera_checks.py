"""What the cameras give, without and with a crop below them."""

import cv2
import numpy as np
import pytest

from fieldnav.messages import CameraName, Frame
from fieldnav.preflight.camera_checks import camera_findings
from fieldnav.preflight.finding import Verdict
from fieldnav.preflight.sampling import Taken


def plain(bench, level):
    """Pictures of one grey, their grain too small to see but enough to tell them from a frozen camera's."""

    def picture(seed):
        image = np.full_like(bench.soil, level)
        image[0, seed] = 255 - level
        return image

    return picture


def test_cameras_that_are_well_are_told_so_line_by_line(bench):
    found = bench.check(bench.crop)

    looked = ["frames", "picture", "lives", "sharpness"]
    of_crop = ["upright", "tilt", "height", "yaw", "rows", "canopy"]
    lines = [f"{name} camera {what}" for name in ("front", "rear") for what in (*looked, *of_crop)]
    assert list(found) == ["front camera opens", "rear camera opens", *lines, "two cameras"]
    assert {finding.verdict for finding in found.values()} == {Verdict.OK}
    assert found["front camera frames"].figure == "640x360 px, 15.0 a second"


def test_without_a_crop_nothing_is_said_of_rows(bench):
    found = bench.check()

    assert not {"front camera upright", "front camera tilt", "front camera rows"} & set(found)


def test_a_camera_that_is_not_there_is_named_and_the_other_still_looked_at(bench):
    bench.source("front", "/dev/video-none")

    found = bench.check()

    opens = found["front camera opens"]
    assert opens.verdict is Verdict.FAIL
    assert opens.figure.startswith("/dev/video-none: there is no such device")
    assert "cameras.front.source" in opens.advice
    assert found["rear camera sharpness"].verdict is Verdict.OK
    assert found["two cameras"].verdict is Verdict.WARNING


def test_a_camera_of_another_size_fails_and_the_other_is_still_looked_at(bench):
    bench.show("rear", lambda seed: bench.lane(seed)[:180])

    found = bench.check(bench.crop)

    assert found["rear camera frames"].verdict is Verdict.FAIL
    assert "gives 640x180 px; the robot file has width_px 640" in found["rear camera frames"].figure
    assert found["front camera tilt"].verdict is Verdict.OK


def test_a_camera_that_gives_one_frame_and_no_more_fails(bench, tmp_path):
    folder = tmp_path / "stuck"
    folder.mkdir()
    cv2.imwrite(str(folder / "0.png"), bench.lane(0))
    bench.source("front", folder)

    found = bench.check()

    assert (found["front camera frames"].verdict, found["front camera frames"].figure) == (
        Verdict.FAIL,
        "1 within 3 s",
    )


def test_a_camera_slower_than_its_file_says_is_warned_of_with_both_rates(bench):
    stamps_s = [0.0, 0.2, 0.4, 0.6]
    frames = [Frame(CameraName.FRONT, n, at_s, bench.lane(n)) for n, at_s in enumerate(stamps_s)]

    arrival = next(camera_findings(CameraName.FRONT, Taken(frames), bench.robot.cameras.front))

    assert arrival.verdict is Verdict.WARNING
    assert "5.0 a second" in arrival.figure
    assert "rate_hz says 15" in arrival.advice


@pytest.mark.parametrize(("level", "words"), [(0, "black"), (255, "white"), (128, "empty")])
def test_a_picture_without_anything_in_it_fails(bench, level, words):
    bench.show("front", plain(bench, level))

    found = bench.check()["front camera picture"]

    assert found.verdict is Verdict.FAIL
    assert found.figure.startswith(f"{words}: brightness {level}, contrast")


def test_a_frozen_camera_fails_and_a_still_picture_is_only_warned_of(bench, tmp_path):
    bench.show("front", lambda _: bench.lane(0))
    bench.source("rear", tmp_path / "rear" / "0.png")

    found = bench.check()

    assert found["front camera lives"].verdict is Verdict.FAIL
    assert "frozen" in found["front camera lives"].figure
    assert found["rear camera lives"].verdict is Verdict.WARNING


def test_a_blurred_camera_is_warned_of_with_its_figure(bench):
    bench.show("front", lambda seed: np.asarray(cv2.GaussianBlur(bench.lane(seed), (0, 0), 3), np.uint8))

    found = bench.check()["front camera sharpness"]

    assert found.verdict is Verdict.WARNING
    assert float(found.figure) < 50
    assert "50 or more" in found.advice


def test_one_camera_named_twice_fails(bench, tmp_path):
    bench.source("rear", tmp_path / "front")
    by_name = bench.check()["two cameras"]
    (tmp_path / "link").symlink_to(tmp_path / "front")
    bench.source("rear", tmp_path / "link")
    by_link = bench.check()["two cameras"]

    assert by_name.verdict is by_link.verdict is Verdict.FAIL
    assert "both have the source" in by_link.figure


def test_two_cameras_that_show_one_scene_fail(bench):
    bench.show("rear", lambda seed: bench.lane(100 + seed))

    found = bench.check()["two cameras"]

    assert found.verdict is Verdict.FAIL
    assert "seem to be one camera" in found.advice
