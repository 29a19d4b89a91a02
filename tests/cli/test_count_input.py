"""`fieldnav count` in rough hands: files in any order, hidden, tiny, cut short, or no video at all."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run
from fieldnav.cli.frames import frames_of
from fieldnav.messages import Image

SIZE_PX = (320, 240)
FRAMES = 20


def write_video(path: Path, size_px: tuple[int, int] = SIZE_PX) -> Path:
    """Frames of grain, so that each takes its share of the file."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 15, size_px)
    for number in range(FRAMES):
        grain = np.random.default_rng(number).integers(0, 256, (size_px[1], size_px[0], 3))
        writer.write(grain.astype(np.uint8))
    writer.release()
    return path


def write_picture(path: Path, level: int) -> None:
    cv2.imwrite(str(path), np.full((SIZE_PX[1], SIZE_PX[0], 3), level, np.uint8))


def levels(folder: Path) -> list[int]:
    """The grey level of each frame, in the order in which they are counted."""
    images: list[Image] = [image for _, image in frames_of(str(folder)).images]
    return [int(image[0, 0, 0]) for image in images]


def test_numbers_in_names_are_ordered_as_numbers(tmp_path: Path) -> None:
    for number in (1, 2, 9, 10, 11, 100):
        write_picture(tmp_path / f"frame{number}.png", number)

    assert levels(tmp_path) == [1, 2, 9, 10, 11, 100]


def test_numbers_of_one_length_and_names_without_keep_their_order(tmp_path: Path) -> None:
    names = ["0009.png", "0010.png", "A.PNG", "b-2.png", "b-10.png", "b.png"]
    for level, name in enumerate(names):
        write_picture(tmp_path / name, level)

    assert levels(tmp_path) == [0, 1, 2, 3, 4, 5]


def test_hidden_files_beside_the_pictures_are_no_frames(tmp_path: Path) -> None:
    write_picture(tmp_path / "1.png", 7)
    (tmp_path / "._1.png").write_bytes(b"what a memory card keeps beside each picture")

    assert levels(tmp_path) == [7]


def test_a_video_too_small_to_show_rows_is_refused(tmp_path: Path, error: Callable[[], str]) -> None:
    video = write_video(tmp_path / "tiny.avi", (32, 24))

    assert run(["count", str(video)]) == 2

    line = error()
    assert line.startswith(f"error: {video}: frame 0: width_px: 32 ") and "from 64 to 8192" in line


def test_a_video_that_is_cut_is_counted_as_far_as_it_goes_and_warned_of(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    video = write_video(tmp_path / "cut.avi")
    video.write_bytes(video.read_bytes()[: video.stat().st_size // 2])

    assert run(["count", str(video)]) == 0

    said = capsys.readouterr()
    seen = int(said.out.split(" crossed in ")[1].split()[0])
    assert FRAMES / 4 < seen < FRAMES * 3 / 4
    warning = f"warning: {video}: gave {seen} of its {FRAMES} frames: it is cut or damaged"
    assert said.err.splitlines()[0] == warning


def test_a_whole_video_is_not_said_to_be_cut(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    video = write_video(tmp_path / "whole.avi")

    assert run(["count", str(video)]) == 0

    said = capsys.readouterr()
    assert f" crossed in {FRAMES} frames, " in said.out and "cut" not in said.err


def test_an_empty_video_is_refused_without_a_word_of_ffmpegs(tmp_path: Path) -> None:
    (tmp_path / "empty.mp4").touch()
    command = [sys.executable, "-m", "fieldnav", "count", "empty.mp4"]

    ended = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)

    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (2, "", 1), ended.stderr
    assert ended.stderr.startswith("error: empty.mp4: is no video that can be read; allowed is")


def test_an_empty_name_is_shown_as_one(error: Callable[[], str]) -> None:
    assert run(["count", ""]) == 2

    assert error().startswith("error: '': is no name that a folder or a video can have; allowed is")


def test_a_damaged_frame_in_a_video_is_named(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    video = write_video(tmp_path / "hole.avi")
    content = video.read_bytes()
    middle = len(content) // 2
    video.write_bytes(content[:middle] + bytes(500) + content[middle + 500 :])

    assert run(["count", str(video)]) == 2

    said = capfd.readouterr().err
    assert said.startswith(f"error: {video}: frame ") and len(said.splitlines()) == 1
    assert ": is no whole picture: its data is damaged; allowed is" in said


def test_frames_that_are_nearly_black_are_warned_of(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for number in range(3):
        write_picture(tmp_path / f"{number}.png", 100 if number == 1 else 3)

    assert run(["count", str(tmp_path)]) == 0

    assert "too dark or too bright for a robot to go by: frames 0, 2\n" in capsys.readouterr().err
