"""`fieldnav check`: a line a check, with the figure and what to do; exit status 1 when one failed."""

import json
from collections.abc import Callable
from dataclasses import replace
from math import radians
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run
from fieldnav.messages import Image
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.loading import load_crop, load_robot

SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
GRAIN = 12.0
"""Grey levels of noise: what keeps two pictures of one scene apart, and a picture sharp."""
WIDTH_PX, HEIGHT_PX, RATE_HZ = 640, 360, 60.0
"""Fast, so that a check soon has its frames."""
PICTURES, ROUNDS = 6, 10
"""Different pictures of a recording, and how often they come: longer than any machine pauses."""
CAMERA = (
    load_robot("bonnbot")
    .cameras.front.model_copy(update={"width_px": WIDTH_PX, "height_px": HEIGHT_PX})
    .pinhole()
)
BEET = load_crop("sugar-beet")
Findings = dict[str, tuple[str, str]]


def lane(seed: int, camera: Pinhole = CAMERA) -> Image:
    """Three rows of leaf discs on soil, as a camera sees them; every seed has other grain."""
    image = np.full((HEIGHT_PX, WIDTH_PX, 3), SOIL_BGR, np.uint8)
    plane = canopy_plane(camera, BEET)
    for place in (0.35, 0.0, -0.35):
        for ahead in np.arange(0.2, 3.5, 0.16) + 0.1 * place:
            u, v = plane.to_image(np.array([ahead, place]))
            if np.isfinite([u, v]).all():
                radius = max(1, round(0.06 * float(plane.pixels_per_metre(v))))
                cv2.circle(image, (round(u), round(v)), radius, LEAF_BGR, cv2.FILLED)
    return grained(image, seed)


def grained(image: Image, seed: int) -> Image:
    noise = np.random.default_rng(seed).normal(0, GRAIN, image.shape)
    return np.asarray(np.clip(image + noise, 0, 255), np.uint8)


def plain(level: int) -> Callable[[int], Image]:
    """Pictures of one grey, their grain too small to see but enough to tell them from a frozen camera's."""

    def picture(seed: int) -> Image:
        image = np.full((HEIGHT_PX, WIDTH_PX, 3), level, np.uint8)
        image[0, seed] = 255 - level
        return image

    return picture


def record(folder: Path, picture: Callable[[int], Image]) -> Path:
    folder.mkdir()
    for seed in range(PICTURES):
        first = folder / f"0-{seed}.png"
        cv2.imwrite(str(first), picture(seed))
        for again in range(1, ROUNDS):
            (folder / f"{again}-{seed}.png").symlink_to(first)
    return folder


class Bench:
    """A robot file whose cameras are recordings, and what the command says of it."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self._folder, self._capsys = folder, capsys
        self._file = folder / "robot.yaml"
        self._document = load_robot("bonnbot").model_dump(mode="json")
        size = {"width_px": WIDTH_PX, "height_px": HEIGHT_PX, "rate_hz": RATE_HZ}
        for name in ("front", "rear"):
            self._document["cameras"][name] |= size
        self.source("front", record(folder / "front", lane))
        self.source("rear", record(folder / "rear", lambda seed: lane(seed)[:, ::-1] // 2))

    def source(self, camera: str, source: Path | str) -> None:
        self._document["cameras"][camera]["source"] = str(source)
        self._file.write_text(json.dumps(self._document))

    def show(self, camera: str, picture: Callable[[int], Image]) -> None:
        self.source(camera, record(self._folder / f"{camera}-shown", picture))

    def set(self, **values: object) -> None:
        self._document |= values
        self._file.write_text(json.dumps(self._document))

    def check(self, *more: str) -> tuple[int, Findings]:
        """The exit status, and each check's result and words."""
        status = run(["check", "--robot", str(self._file), "--json", *more])
        said = json.loads(self._capsys.readouterr().out)
        assert said["ok"] is (status == 0)
        assert said["not_checked"] == ["bus", "wheel modules"]
        return status, {
            one["check"]: (one["result"], f"{one['figure']}; {one['advice']}") for one in said["checks"]
        }


@pytest.fixture
def bench(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Bench:
    return Bench(tmp_path, capsys)


def test_a_robot_that_is_well_has_a_line_a_check_and_status_0(
    bench: Bench, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status = run(["check", "--robot", str(tmp_path / "robot.yaml"), "--crop", "sugar-beet"])

    said = capsys.readouterr()
    lines = said.out.splitlines()
    assert (status, said.err) == (0, "")
    assert lines[-1] == "not checked: bus, wheel modules"
    assert [line.split()[0] for line in lines[:-1]] == ["ok"] * (len(lines) - 1)
    of_a_camera = ["opens", "frames", "picture", "lives", "sharpness", "upright", "tilt", "height", "yaw"]
    checks = [f"{name} camera {what}" for name in ("front", "rear") for what in of_a_camera]
    expected = ["robot file", "crop profile", "crop fits robot", *checks, "two cameras"]
    assert [line[9:33].strip() for line in lines[:-1]] == expected


def test_without_a_crop_nothing_is_said_of_rows(bench: Bench) -> None:
    status, found = bench.check()

    assert status == 0
    assert not {"crop profile", "front camera upright", "front camera tilt"} & set(found)


def test_a_wrong_robot_file_is_one_failed_check(bench: Bench) -> None:
    bench.set(timeouts={"frame_s": -1})

    status, found = bench.check()

    assert status == 2, "wrong input"
    assert list(found) == ["robot file"]
    assert found["robot file"][0] == "fail"
    assert "timeouts.frame_s" in found["robot file"][1]


def test_a_crop_that_is_unknown_or_does_not_fit_fails_and_the_cameras_are_still_looked_at(
    bench: Bench,
) -> None:
    wrong, unknown = bench.check("--crop", "sugar-beat")
    bench.set(geometry=load_robot("bonnbot").geometry.model_dump() | {"clearance_m": 0.1})
    status, unfit = bench.check("--crop", "sugar-beet")

    assert wrong == 2, "wrong input"
    assert unknown["crop profile"][0] == "fail" and "sugar-beet" in unknown["crop profile"][1]
    assert unknown["front camera frames"][0] == "ok"
    assert status == 1
    assert unfit["crop fits robot"][0] == "fail" and "clearance_m 0.1" in unfit["crop fits robot"][1]


def test_a_camera_that_is_not_there_is_named_and_the_other_still_looked_at(bench: Bench) -> None:
    bench.source("front", "/dev/video-none")

    status, found = bench.check()

    assert status == 1
    result, words = found["front camera opens"]
    assert result == "fail"
    assert words.startswith("/dev/video-none: there is no such device") and "cameras.front.source" in words
    assert found["rear camera sharpness"][0] == "ok"
    assert found["two cameras"][0] == "warning"


def test_a_camera_of_another_size_fails(bench: Bench) -> None:
    bench.show("rear", lambda seed: lane(seed)[:180])

    status, found = bench.check()

    assert status == 1
    result, words = found["rear camera frames"]
    assert result == "fail"
    assert "gives 640x180 px; the robot file has width_px 640" in words


@pytest.mark.parametrize(("level", "words"), [(0, "black"), (255, "white"), (128, "empty")])
def test_a_picture_without_anything_in_it_fails(bench: Bench, level: int, words: str) -> None:
    bench.show("front", plain(level))

    status, found = bench.check()

    assert status == 1
    assert found["front camera picture"][0] == "fail"
    assert found["front camera picture"][1].startswith(f"{words}: brightness {level}, contrast")


def test_a_frozen_camera_fails_and_a_still_picture_is_only_warned_of(bench: Bench, tmp_path: Path) -> None:
    bench.show("front", lambda _: lane(0))
    bench.source("rear", tmp_path / "rear" / "0-0.png")

    status, found = bench.check()

    assert status == 1
    assert found["front camera lives"][0] == "fail" and "frozen" in found["front camera lives"][1]
    assert found["rear camera lives"][0] == "warning"


def test_a_blurred_camera_is_warned_of_with_its_figure(bench: Bench) -> None:
    bench.show("front", lambda seed: np.asarray(cv2.GaussianBlur(lane(seed), (0, 0), 3), np.uint8))

    status, found = bench.check()

    assert status == 0, "a warning is no failure"
    result, words = found["front camera sharpness"]
    assert result == "warning"
    assert float(words.split(";")[0]) < 50
    assert "50 or more" in words


def test_one_camera_named_twice_fails(bench: Bench, tmp_path: Path) -> None:
    bench.source("rear", tmp_path / "front")
    _, by_name = bench.check()
    (tmp_path / "link").symlink_to(tmp_path / "front")
    bench.source("rear", tmp_path / "link")
    _, by_link = bench.check()

    assert by_name["two cameras"][0] == by_link["two cameras"][0] == "fail"
    assert "both have the source" in by_link["two cameras"][1]


def test_two_cameras_that_show_one_scene_fail(bench: Bench) -> None:
    bench.show("rear", lambda seed: lane(100 + seed))

    status, found = bench.check()

    assert status == 1
    assert found["two cameras"][0] == "fail" and "seem to be one camera" in found["two cameras"][1]


def test_a_camera_upside_down_fails_by_how_its_rows_converge(bench: Bench) -> None:
    bench.show("front", lambda seed: lane(seed)[::-1, ::-1])

    status, found = bench.check("--crop", "sugar-beet")

    assert status == 1
    assert found["front camera upright"] == (
        "fail",
        "rows converge towards the bottom; it hangs upside down: turn it, or its picture",
    )
    assert found["rear camera upright"][0] == "ok"
    assert "front camera tilt" not in found, "the pose of such a picture means nothing"


def test_a_camera_knocked_far_off_is_warned_of_with_value_file_and_limit(bench: Bench) -> None:
    knocked = replace(CAMERA, tilt_rad=radians(80))
    bench.show("front", lambda seed: lane(seed, knocked))

    status, found = bench.check("--crop", "sugar-beet")

    assert status == 0, "a warning is no failure"
    result, words = found["front camera tilt"]
    assert result == "warning"
    assert "65 in the file, limit 4" in words
    assert float(words.split()[0]) > 72
    assert found["front camera height"][0] == "ok"
    assert found["rear camera tilt"][0] == "ok"


def test_over_bare_soil_the_pose_cannot_be_told(bench: Bench) -> None:
    bench.show("front", lambda seed: grained(np.full((HEIGHT_PX, WIDTH_PX, 3), SOIL_BGR, np.uint8), seed))

    status, found = bench.check("--crop", "sugar-beet")

    assert status == 0
    assert found["front camera pose"][0] == "warning"
    assert "no two rows seen" in found["front camera pose"][1]
    assert "front camera upright" not in found


def test_a_robot_must_be_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check"]) == 2
    assert "--robot" in capsys.readouterr().err
