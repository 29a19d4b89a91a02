"""`fieldnav count`: rows passing sideways, from a folder and a video; one line for wrong input."""

import json
import re
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run
from fieldnav.messages import Image

SIZE_PX = (320, 240)
SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
SPACING_PX, PLANT_PX, STEP_PX = 90, 24, 10
PLACES_PX = range(0, 230, STEP_PX)
"""How far the camera stands to the right of its first place, which is 35 px short of a row."""
CROSSED = [4, 13, 22]
"""The first frames in which the rows at 35, 125 and 215 px lie to the left of the middle."""


def ground() -> Image:
    """A strip of rows seen from straight above, one of them 35 px right of the first picture's middle."""
    rng = np.random.default_rng(3)
    strip = np.full((SIZE_PX[1], 800, 3), SOIL_BGR, np.uint8)
    for row in range(SIZE_PX[0] // 2 + 35 - 2 * SPACING_PX, 800, SPACING_PX):
        for y in range(8, SIZE_PX[1], PLANT_PX):
            at = (row + int(rng.integers(-3, 4)), y + int(rng.integers(-6, 7)))
            cv2.circle(strip, at, int(rng.integers(6, 11)), LEAF_BGR, cv2.FILLED)
    return strip


def pictures(places_px: Sequence[int] = PLACES_PX) -> list[Image]:
    strip = ground()
    return [strip[:, place : place + SIZE_PX[0]] for place in places_px]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write(tmp_path / "frames", pictures())
    return tmp_path / "frames"


def write(folder: Path, images: Sequence[Image]) -> None:
    folder.mkdir()
    for number, image in enumerate(images):
        cv2.imwrite(str(folder / f"{number:04}.png"), image)


def error(capsys: pytest.CaptureFixture[str]) -> str:
    """The one line on standard error; nothing may stand on standard output."""
    captured = capsys.readouterr()
    lines = captured.err.splitlines()
    assert captured.out == "" and len(lines) == 1, captured
    return lines[0]


def test_a_program_gets_the_count_and_the_frames_and_nothing_else(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["count", str(folder), "--json"]) == 0

    captured = capsys.readouterr()
    counted = json.loads(captured.out)
    assert list(counted) == ["rows_crossed", "frames"] and captured.err == ""
    assert counted["rows_crossed"] == 3
    assert counted["frames"] == pytest.approx(CROSSED, abs=1)


@pytest.mark.parametrize(("direction", "net"), [("right", 3), ("left", -3)])
def test_the_direction_says_which_way_counts_up(
    direction: str, net: int, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["count", str(folder), "--direction", direction, "--json"]) == 0

    assert json.loads(capsys.readouterr().out)["rows_crossed"] == net


def test_without_a_direction_moving_left_counts_up_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "back", pictures(PLACES_PX[::-1]))

    assert run(["count", str(tmp_path / "back"), "--json"]) == 0

    assert json.loads(capsys.readouterr().out)["rows_crossed"] == 3


def test_a_person_reads_each_passage_and_the_running_count(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(tmp_path / "frames", pictures([*range(0, 150, 10), *range(140, 90, -10)]))

    assert run(["count", str(tmp_path / "frames"), "--direction", "right"]) == 0

    title, _, *rows = capsys.readouterr().out.rstrip().splitlines()
    assert title == f"{tmp_path}/frames: 1 row crossed in 20 frames, right counts up"
    assert [re.split(r" +", row.strip())[2:] for row in rows] == [
        ["right", "+1"],
        ["right", "+2"],
        ["left", "+1"],
    ]


def test_a_video_is_counted_like_a_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    video = tmp_path / "frames.avi"
    writer = cv2.VideoWriter(str(video), cv2.VideoWriter.fourcc(*"MJPG"), 15, SIZE_PX)
    for image in pictures():
        writer.write(image)
    writer.release()

    assert run(["count", str(video), "--json"]) == 0

    assert json.loads(capsys.readouterr().out)["rows_crossed"] == 3


def test_crop_and_robot_may_be_named(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["count", str(folder), "--crop", "sugar-beet", "--robot", "bonnbot", "--json"]) == 0

    assert json.loads(capsys.readouterr().out)["rows_crossed"] == 3


def test_frames_that_show_no_known_ground_are_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    images = pictures()
    images[7] = np.zeros_like(images[7])
    write(tmp_path / "frames", images)

    assert run(["count", str(tmp_path / "frames"), "--json"]) == 0

    captured = capsys.readouterr()
    assert json.loads(captured.out)["rows_crossed"] == 3
    assert captured.err.startswith(f"warning: {tmp_path}/frames: ") and captured.err.endswith(": 7\n")


def test_bare_soil_crosses_no_row(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tmp_path / "bare", [np.full((240, 320, 3), SOIL_BGR, np.uint8)] * 3)

    assert run(["count", str(tmp_path / "bare"), "--json"]) == 0

    assert json.loads(capsys.readouterr().out) == {"rows_crossed": 0, "frames": []}


def test_what_is_neither_folder_nor_video_is_refused(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words, empty = tmp_path / "words.mp4", tmp_path / "empty"
    words.write_text("no video")
    empty.mkdir()

    said = {
        tmp_path / "absent": "there is no such folder or video",
        words: "is no video that can be read; allowed is a folder of pictures, or a video",
        empty: "holds no picture; allowed are .jpg",
        folder / "0000.png": "is a single picture; allowed is a folder of pictures",
        Path("/dev/null"): "is a pipe or a device; allowed is a folder of pictures",
    }
    for path, words_said in said.items():
        assert run(["count", str(path), "--json"]) == 2
        assert f"error: {path}: {words_said}" in error(capsys)


def test_a_frame_of_another_size_is_refused_by_its_name(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cv2.imwrite(str(folder / "0005.png"), np.zeros((120, 160, 3), np.uint8))

    assert run(["count", str(folder)]) == 2

    assert error(capsys) == (
        f"error: {folder}/0005.png: is 160x120 px; allowed is 320x240 px, the size of the first frame"
    )


def test_a_frame_that_is_no_picture_is_refused_by_its_name(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "0003.png").write_bytes(b"nothing")

    assert run(["count", str(folder)]) == 2

    assert f"{folder}/0003.png: is no whole picture" in error(capsys)


@pytest.mark.parametrize("option", ["--crop", "--robot"])
def test_an_unknown_profile_is_refused(option: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["count", str(folder), option, "nobody"]) == 2

    assert "unknown" in error(capsys)


def test_an_unknown_direction_is_refused_with_those_allowed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["count", str(folder), "--direction", "up"]) == 2

    line = error(capsys)
    assert "--direction" in line and "'up'" in line and "right" in line and "left" in line
