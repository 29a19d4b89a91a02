"""`fieldnav detect`: rows of pictures as JSON, as a table, drawn in; one line for what is none."""

import json
import re
import resource
import struct
import subprocess
import sys
import zlib
from importlib.resources import files
from math import atan2, degrees
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run
from fieldnav.messages import Image
from fieldnav.pinhole import Pinhole
from fieldnav.settings.loading import load_robot

SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
ROW_SPACING_M, PLANT_SPACING_M, LEAF_M = 0.35, 0.15, 0.06


def camera(width_px: int, height_px: int) -> Pinhole:
    settings = load_robot("bonnbot").cameras.front
    return settings.model_copy(update={"width_px": width_px, "height_px": height_px}).pinhole()


def field(view: Pinhole, rows: int = 3) -> Image:
    """Discs of leaf along straight rows, as this camera sees them."""
    image = np.full((view.height_px, view.width_px, 3), SOIL_BGR, np.uint8)
    for row in range(rows):
        y = ((rows - 1) / 2 - row) * ROW_SPACING_M
        for x in np.arange(0.5, 2.5, PLANT_SPACING_M):
            u, v = view.to_image(np.array([x, y]))
            radius = float(view.pixels_per_metre(v)) * LEAF_M
            cv2.circle(image, (round(u), round(v)), round(radius), LEAF_BGR, cv2.FILLED)
    return image


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    path = tmp_path / "in" / "field.png"
    path.parent.mkdir()
    cv2.imwrite(str(path), field(camera(1280, 720)))
    return path


def objects(capsys: pytest.CaptureFixture[str]) -> list[dict[str, object]]:
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


def error(capsys: pytest.CaptureFixture[str]) -> str:
    """The one line on standard error; nothing may stand on standard output."""
    captured = capsys.readouterr()
    lines = captured.err.splitlines()
    assert captured.out == "" and len(lines) == 1, captured
    return lines[0]


@pytest.mark.parametrize("size", [(1280, 720), (640, 480), (320, 240), (1920, 1080)])
def test_rows_are_found_whatever_the_pictures_size(
    size: tuple[int, int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    view, path = camera(*size), tmp_path / "field.png"
    cv2.imwrite(str(path), field(view))

    assert run(["detect", str(path), "--json"]) == 0

    (found,) = objects(capsys)
    assert (found["image"], found["width"], found["height"]) == (str(path), *size)
    assert float(str(found["milliseconds"])) > 0
    rows = found["rows"]
    assert isinstance(rows, list) and len(rows) == 3
    for row, place_m in zip(rows, (0.35, 0.0, -0.35), strict=True):
        true = view.row_in_image(place_m, 0.0)
        assert row["x_bottom"] == pytest.approx(true.x_bottom_px, abs=0.02 * size[0])
        assert row["x_top"] == pytest.approx(true.x_top_px, abs=0.02 * size[0])
        angle = degrees(atan2(row["x_top"] - row["x_bottom"], size[1] - 1))
        assert row["angle_deg"] == pytest.approx(angle, abs=0.05)
        assert 0 < row["score"] <= 1
    assert rows[0]["angle_deg"] > 0 > rows[2]["angle_deg"], "the left row leans right, so clockwise"


def test_one_object_a_line_in_the_order_given(
    picture: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bare = tmp_path / "bare.png"
    cv2.imwrite(str(bare), np.full((720, 1280, 3), SOIL_BGR, np.uint8))

    assert run(["detect", str(bare), str(picture), str(bare), "--json"]) == 0

    found = objects(capsys)
    assert [each["image"] for each in found] == [str(bare), str(picture), str(bare)]
    assert found[0]["rows"] == found[2]["rows"] == []
    assert set(found[1]) == {"image", "width", "height", "rows", "milliseconds"}


def test_a_person_reads_a_table(picture: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["detect", str(picture), "--crop", "sugar-beet"]) == 0

    out = capsys.readouterr().out
    assert f"{picture}: 3 rows" in out
    assert len(re.findall(r"^ +[123] .* px .* px .* deg +0\.\d\d *$", out, flags=re.MULTILINE)) == 3


def test_the_overlay_is_the_picture_with_a_graph_beneath(picture: Path, tmp_path: Path) -> None:
    folder = tmp_path / "new" / "overlays"
    other = tmp_path / "in" / "field.jpg"
    cv2.imwrite(str(other), field(camera(320, 240)))

    assert run(["detect", str(picture), str(other), "--overlay", str(folder), "--json"]) == 0

    first, second = (cv2.imread(str(folder / name)) for name in ("field-rows.jpg", "field-2-rows.jpg"))
    assert first is not None and second is not None
    assert first.shape[1] == 1280 and first.shape[0] > 720
    assert second.shape[1] == 960 and second.shape[0] > 720, "a small picture is shown three times as large"
    plain = field(camera(1280, 720))
    assert np.abs(first[:720].astype(int) - plain).max(axis=2).mean() > 1, "something is drawn in"
    assert (np.abs(first[:720].astype(int) - plain).max(axis=2) < 40).mean() > 0.8, (
        "the picture is still seen"
    )
    assert sorted(path.name for path in picture.parent.iterdir()) == ["field.jpg", "field.png"]


def test_the_bare_field_has_an_overlay_too(tmp_path: Path) -> None:
    bare = tmp_path / "bare.png"
    cv2.imwrite(str(bare), np.full((72, 128, 3), SOIL_BGR, np.uint8))

    assert run(["detect", str(bare), "--overlay", str(tmp_path / "overlays")]) == 0

    assert (tmp_path / "overlays" / "bare-rows.jpg").exists()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "there is no such file"),
        (b"", "is no whole picture; allowed is JPEG, PNG, TIFF, BMP or WebP"),
        (b"name: sugar-beet\n", "is no whole picture; allowed is JPEG, PNG, TIFF, BMP or WebP"),
    ],
)
def test_what_is_no_picture_is_refused_before_anything_is_written(
    content: bytes | None, said: str, picture: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = tmp_path / "wrong.jpg"
    if content is not None:
        wrong.write_bytes(content)

    assert run(["detect", str(picture), str(wrong), "--overlay", str(tmp_path / "overlays"), "--json"]) == 2

    line = error(capsys)
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
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "huge.png").write_bytes(png(100_000, 100_000))

    assert run(["detect", str(tmp_path / "huge.png")]) == 2

    assert f"{tmp_path}/huge.png: is no whole picture" in error(capsys)


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


def test_a_picture_so_tall_that_it_shows_the_horizon_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tall = tmp_path / "tall.png"
    cv2.imwrite(str(tall), np.full((8000, 64, 3), LEAF_BGR, np.uint8))

    assert run(["detect", str(tall)]) == 2

    line = error(capsys)
    assert f"{tall}: tilt_deg 65 with horizontal_fov_deg 69 at 64x8000 px looks at the horizon" in line


def test_a_picture_is_named_as_it_was_typed(
    picture: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(picture.parent)

    assert run(["detect", "./field.png", "--json"]) == 0
    assert objects(capsys)[0]["image"] == "./field.png"
    assert run(["detect", "./none.png"]) == 2
    assert error(capsys) == "error: ./none.png: there is no such file"


def test_a_window_so_wide_that_it_has_few_places_finds_rows_or_none(
    picture: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    crop = tmp_path / "mine.yaml"
    text = (files("config") / "crops" / "sugar-beet.yaml").read_text(encoding="utf-8")
    crop.write_text(f"{text}finding: {{ window: 0.5, stride: 0.1, neighbours: 100 }}\n")

    assert run(["detect", str(picture), "--crop", str(crop), "--json"]) == 0

    assert isinstance(objects(capsys)[0]["rows"], list)


def test_a_folder_in_place_of_a_picture_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(tmp_path)]) == 2

    assert f"{tmp_path}: cannot be read" in error(capsys)


def test_a_picture_that_no_camera_takes_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tiny = tmp_path / "tiny.png"
    cv2.imwrite(str(tiny), np.zeros((10, 20, 3), np.uint8))

    assert run(["detect", str(tiny)]) == 2

    line = error(capsys)
    assert str(tiny) in line and "width_px: 20" in line and "from 64 to 8192" in line


def test_an_overlay_folder_that_cannot_be_written_is_refused(
    picture: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = picture / "overlays"

    assert run(["detect", str(picture), "--overlay", str(folder), "--json"]) == 2

    line = error(capsys)
    assert str(folder) in line and "allowed is a folder you can write" in line


@pytest.mark.parametrize("option", ["--crop", "--robot"])
def test_an_unknown_profile_is_refused(
    option: str, picture: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(picture), option, "nobody"]) == 2

    assert "unknown" in error(capsys)
