"""`fieldnav detect`: one line for what is no picture, no folder, no profile."""

import resource
import struct
import subprocess
import sys
import zlib
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "there is no such file"),
        (b"", "is no whole picture; allowed is JPEG, PNG, TIFF, BMP or WebP"),
        (b"name: sugar-beet\n", "is no whole picture; allowed is JPEG, PNG, TIFF, BMP or WebP"),
    ],
)
def test_what_is_no_picture_is_refused_before_anything_is_written(
    content: bytes | None, said: str, picture: Path, tmp_path: Path, error: Callable[[], str]
) -> None:
    wrong = tmp_path / "wrong.jpg"
    if content is not None:
        wrong.write_bytes(content)

    assert run(["detect", str(picture), str(wrong), "--overlay", str(tmp_path / "overlays"), "--json"]) == 2

    line = error()
    assert str(wrong) in line and said in line
    assert not (tmp_path / "overlays").exists()


def png(width_px: int, height_px: int, pixels: bytes = b"") -> bytes:
    """A PNG file whose head claims this size, whatever it holds."""
    head = struct.pack(">IIBBBBB", width_px, height_px, 8, 2, 0, 0, 0)
    parts = ((b"IHDR", head), (b"IDAT", zlib.compress(pixels)), (b"IEND", b""))
    made = (
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in parts
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(made)


def test_a_picture_that_claims_more_than_opencv_takes_is_refused(
    tmp_path: Path, error: Callable[[], str]
) -> None:
    (tmp_path / "huge.png").write_bytes(png(100_000, 100_000))

    assert run(["detect", str(tmp_path / "huge.png")]) == 2

    assert f"{tmp_path}/huge.png: is no whole picture" in error()


def test_a_picture_that_claims_more_than_a_camera_takes_is_given_no_memory(tmp_path: Path) -> None:
    (tmp_path / "large.png").write_bytes(png(30_000, 30_000))
    command = [sys.executable, "-m", "fieldnav", "detect", "large.png"]

    ended = subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=tmp_path, preexec_fn=little_memory
    )

    assert (ended.returncode, ended.stdout) == (2, "")
    assert ended.stderr == (
        "error: large.png: is no whole picture; allowed is JPEG, PNG, TIFF, BMP or WebP of at most 8192 px a "
        "side\n"
    )


def little_memory() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (2 * 2**30, 2 * 2**30))


def test_a_picture_that_is_cut_off_is_refused_in_one_line(
    picture: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    picture.write_bytes(picture.read_bytes()[:2000])

    assert run(["detect", str(picture)]) == 2

    captured = capfd.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(f"error: {picture}: is no whole picture") and captured.err.count("\n") == 1


def test_a_picture_so_tall_that_a_robots_camera_would_show_the_horizon_is_refused(
    tmp_path: Path, plots: SimpleNamespace, error: Callable[[], str]
) -> None:
    tall = tmp_path / "tall.png"
    cv2.imwrite(str(tall), np.full((8000, 64, 3), plots.leaf_bgr, np.uint8))

    assert run(["detect", str(tall), "--robot", "bonnbot"]) == 2

    line = error()
    assert f"{tall}: tilt_deg 65 with horizontal_fov_deg 69 at 64x8000 px looks at the horizon" in line


def test_a_folder_in_place_of_a_picture_is_refused(tmp_path: Path, error: Callable[[], str]) -> None:
    assert run(["detect", str(tmp_path)]) == 2

    assert f"{tmp_path}: cannot be read" in error()


@pytest.mark.parametrize("options", [[], ["--robot", "bonnbot"]], ids=" ".join)
def test_a_picture_that_no_camera_takes_is_refused(
    options: list[str], tmp_path: Path, error: Callable[[], str]
) -> None:
    tiny = tmp_path / "tiny.png"
    cv2.imwrite(str(tiny), np.zeros((10, 20, 3), np.uint8))

    assert run(["detect", str(tiny), *options]) == 2

    line = error()
    assert str(tiny) in line and "width_px: 20" in line and "from 64 to 8192" in line


def test_an_overlay_folder_that_cannot_be_written_is_refused(picture: Path, error: Callable[[], str]) -> None:
    folder = picture / "overlays"

    assert run(["detect", str(picture), "--overlay", str(folder), "--json"]) == 2

    line = error()
    assert str(folder) in line and "allowed is a folder you can write" in line


@pytest.mark.parametrize("option", ["--crop", "--robot"])
def test_an_unknown_profile_is_refused(option: str, picture: Path, error: Callable[[], str]) -> None:
    assert run(["detect", str(picture), option, "nobody"]) == 2

    assert "unknown" in error()
