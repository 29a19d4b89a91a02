"""`fieldnav detect`: rows of pictures as JSON, as a table, drawn in; one line for what is none."""

import json
import re
import resource
import struct
import subprocess
import sys
import zlib
from importlib.resources import files
from math import atan2, degrees, radians, tan
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from fieldnav.cli.app import run
from fieldnav.messages import Image
from fieldnav.pinhole import Pinhole
from fieldnav.settings.loading import load_robot

SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
ROW_SPACING_M, PLANT_SPACING_M, LEAF_M = 0.35, 0.15, 0.06
BEND_RADIUS_M = 12.0
CAMERA_KEYS = {"estimated", "tilt_deg", "height_m", "horizon_px"}


def camera(width_px: int, height_px: int) -> Pinhole:
    settings = load_robot("bonnbot").cameras.front
    return settings.model_copy(update={"width_px": width_px, "height_px": height_px}).pinhole()


def field(view: Pinhole, bend_per_m: float = 0.0, furthest_m: float = 2.5, rows: int = 3) -> Image:
    """Discs of leaf along rows, as this camera sees them; they bend to the left."""
    image = np.full((view.height_px, view.width_px, 3), SOIL_BGR, np.uint8)
    for row in range(rows):
        y = ((rows - 1) / 2 - row) * ROW_SPACING_M
        for x in np.arange(0.5, furthest_m, PLANT_SPACING_M):
            u, v = view.to_image(np.array([x, y + bend_per_m * x * x / 2]))
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


@pytest.mark.parametrize("options", [["--robot", "bonnbot"], ["--crop", "sugar-beet"], []], ids=" ".join)
@pytest.mark.parametrize("size", [(1280, 720), (640, 480), (320, 240), (1920, 1080)])
def test_rows_are_found_whatever_the_pictures_size(
    size: tuple[int, int], options: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    view, path = camera(*size), tmp_path / "field.png"
    cv2.imwrite(str(path), field(view))

    assert run(["detect", str(path), *options, "--json"]) == 0

    (found,) = objects(capsys)
    assert (found["image"], found["width"], found["height"]) == (str(path), *size)
    assert float(str(found["milliseconds"])) > 0
    rows = found["rows"]
    assert isinstance(rows, list) and len(rows) == 3, "beside them is soil"
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
    assert set(found[1]) == {"image", "width", "height", "rows", "camera", "milliseconds"}
    rows, told = found[1]["rows"], found[1]["camera"]
    assert isinstance(rows, list) and isinstance(told, dict)
    assert set(rows[0]) == {"x_top", "x_bottom", "angle_deg", "score", "points"}
    assert set(told) == CAMERA_KEYS


def test_a_person_reads_a_table(picture: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["detect", str(picture), "--crop", "sugar-beet"]) == 0

    out = capsys.readouterr().out
    title = re.search(
        rf"^{re.escape(str(picture))}: (\d) rows, \d+ plants, 1280x720, .* ms$", out, re.MULTILINE
    )
    assert title, out
    rows = re.findall(r"^ +\d .* px .* px .* deg +[01]\.\d\d *$", out, re.MULTILINE)
    assert len(rows) == int(title[1]) == 3


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (
            [],
            r"camera estimated from the picture, .*: tilt 6\d\.\d deg, height unknown without a crop",
        ),
        (
            ["--crop", "sugar-beet"],
            r"camera estimated .* height [01]\.\d\d m by the row spacing of sugar-beet",
        ),
        (
            ["--robot", "thorvald"],
            r"camera of thorvald: tilt \d+\.\d deg, height \d\.\d\d m, horizon at y = -",
        ),
    ],
    ids=" ".join,
)
def test_a_person_is_told_where_the_camera_is_and_who_says_so(
    options: list[str], said: str, picture: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(picture), *options]) == 0

    assert re.search(f"^{said}", capsys.readouterr().out, re.MULTILINE)


def test_a_person_is_told_that_a_picture_without_rows_says_nothing_of_its_camera(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cv2.imwrite(str(tmp_path / "bare.png"), np.full((72, 128, 3), SOIL_BGR, np.uint8))

    assert run(["detect", str(tmp_path / "bare.png")]) == 0

    assert "bare.png: no row, 128x72" in (out := capsys.readouterr().out)
    assert "camera unknown" in out


def test_an_unknown_camera_is_estimated_near_the_one_that_took_the_picture(
    picture: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    taken = camera(1280, 720)

    assert run(["detect", str(picture), "--crop", "sugar-beet", "--json"]) == 0

    told = objects(capsys)[0]["camera"]
    assert isinstance(told, dict) and told["estimated"] is True
    assert told["tilt_deg"] == pytest.approx(degrees(taken.tilt_rad), abs=8)
    assert told["height_m"] == pytest.approx(taken.height_m, rel=0.15)
    assert told["horizon_px"] < 0


def test_without_a_crop_the_cameras_height_is_unknown(
    picture: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(picture), "--json"]) == 0

    told = objects(capsys)[0]["camera"]
    assert isinstance(told, dict)
    assert told["estimated"] is True and told["height_m"] is None and told["tilt_deg"] > 0


def test_without_rows_nothing_is_said_of_the_camera(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cv2.imwrite(str(tmp_path / "bare.png"), np.full((72, 128, 3), SOIL_BGR, np.uint8))

    assert run(["detect", str(tmp_path / "bare.png"), "--json"]) == 0

    assert objects(capsys)[0]["camera"] == dict.fromkeys(CAMERA_KEYS) | {"estimated": True}


def test_a_robots_camera_is_taken_from_its_file(picture: Path, capsys: pytest.CaptureFixture[str]) -> None:
    taken = camera(1280, 720)

    assert run(["detect", str(picture), "--robot", "bonnbot", "--json"]) == 0

    horizon_px = taken.centre_y_px - taken.focal_px * tan(taken.tilt_rad)
    assert objects(capsys)[0]["camera"] == {
        "estimated": False,
        "tilt_deg": 65.0,
        "height_m": 1.0,
        "horizon_px": pytest.approx(horizon_px, abs=0.06),
    }


@pytest.mark.parametrize("options", [[], ["--robot", "bonnbot"]], ids=" ".join)
def test_straight_rows_have_points_along_their_lines(
    options: list[str], picture: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(picture), *options, "--json"]) == 0

    rows = objects(capsys)[0]["rows"]
    assert isinstance(rows, list) and rows
    for row in rows:
        x, y = np.array(row["points"]).T
        assert len(x) == 9 and (y[0], y[-1]) == (0, 719) and (np.diff(y) > 0).all()
        line = row["x_top"] + (row["x_bottom"] - row["x_top"]) * y / 719
        assert np.abs(x - line).max() < 0.01 * 1280


def test_curved_rows_have_points_along_their_curves(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ahead = Pinhole(640, 480, 480.0, 1.2, radians(35), 0.0)
    path = tmp_path / "bend.png"
    cv2.imwrite(str(path), field(ahead, 1 / BEND_RADIUS_M, furthest_m=9.0, rows=9))

    assert run(["detect", str(path), "--json"]) == 0

    rows = objects(capsys)[0]["rows"]
    assert isinstance(rows, list) and rows
    row = min(rows, key=lambda each: abs(each["x_bottom"] - 320))
    x, y = np.array(row["points"]).T
    distance_m = np.arange(0.5, 9.0, 0.01)
    bend = np.stack([distance_m, distance_m**2 / 2 / BEND_RADIUS_M], axis=-1)
    true = ahead.to_image(bend)[::-1]
    seen = y > 60
    off = x - np.interp(y, true[:, 1], true[:, 0])
    assert np.abs(off[seen]).max() < 0.02 * 640
    straight = row["x_top"] + (row["x_bottom"] - row["x_top"]) * y / 479
    assert np.abs(x - straight)[seen].max() > 0.01 * 640, "the line alone would not tell of the bend"


def test_the_overlay_is_the_picture_with_a_graph_beneath(picture: Path, tmp_path: Path) -> None:
    folder = tmp_path / "new" / "overlays"
    other = tmp_path / "in" / "field.jpg"
    cv2.imwrite(str(other), field(camera(320, 240)))

    assert run(["detect", str(picture), str(other), "--overlay", str(folder), "--json"]) == 0

    first, second = (cv2.imread(str(folder / name)) for name in ("field-rows.jpg", "field-2-rows.jpg"))
    assert first is not None and second is not None
    assert first.shape[1] == 1280 and first.shape[0] > 720
    assert second.shape[1] == 1280 and second.shape[0] > 960, "a small picture is shown four times as large"
    assert sorted(path.name for path in picture.parent.iterdir()) == ["field.jpg", "field.png"]


@pytest.mark.parametrize("options", [[], ["--robot", "bonnbot"]], ids=" ".join)
def test_the_overlay_differs_from_the_picture_where_rows_are(
    options: list[str], picture: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(picture), *options, "--overlay", str(tmp_path), "--json"]) == 0

    rows = objects(capsys)[0]["rows"]
    drawn = cv2.imread(str(tmp_path / "field-rows.jpg"))
    assert drawn is not None and isinstance(rows, list)
    changed = np.abs(drawn[:720].astype(int) - field(camera(1280, 720))).max(axis=2)
    middle = rows[len(rows) // 2]
    y = np.arange(40, 680)
    x = np.interp(y, [point[1] for point in middle["points"]], [point[0] for point in middle["points"]])
    assert changed[y, np.rint(x).astype(int)].min() > 60, "the row is one unbroken line"
    between = np.rint(x + 70).astype(int)
    assert np.median(changed[y, between]) < 40, "the ground beside it is still seen"


def test_the_overlay_marks_rows_at_the_same_place_in_the_picture_and_in_the_graph(
    picture: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(picture), "--robot", "bonnbot", "--overlay", str(tmp_path), "--json"]) == 0

    rows = objects(capsys)[0]["rows"]
    drawn = cv2.imread(str(tmp_path / "field-rows.jpg"))
    assert drawn is not None and isinstance(rows, list)
    for row in rows:
        x = round(row["points"][4][0])
        if 10 <= x < 1270:
            assert blue(drawn[359:361, x - 3 : x + 4]), "the square on the row"
            assert blue(drawn[-23:-16, x - 3 : x + 4]), "the square in the graph beneath it"


def blue(part: NDArray[Any]) -> bool:
    """Whether that is the colour of a row that is sure, which neither leaf nor soil nor paper has."""
    colour = part.reshape(-1, 3).mean(axis=0)
    return bool(colour[0] > 180 and colour[2] < 110)


@pytest.mark.parametrize("options", [[], ["--robot", "bonnbot"]], ids=" ".join)
def test_the_bare_field_has_an_overlay_too(options: list[str], tmp_path: Path) -> None:
    bare = tmp_path / "bare.png"
    cv2.imwrite(str(bare), np.full((72, 128, 3), SOIL_BGR, np.uint8))

    assert run(["detect", str(bare), *options, "--overlay", str(tmp_path / "overlays")]) == 0

    assert (tmp_path / "overlays" / "bare-rows.jpg").exists()


@pytest.mark.parametrize("size", [(64, 2000), (2000, 64)])
def test_pictures_of_odd_shapes_have_overlays(size: tuple[int, int], tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "odd.png"), np.full((size[1], size[0], 3), LEAF_BGR, np.uint8))

    assert run(["detect", str(tmp_path / "odd.png"), "--overlay", str(tmp_path), "--json"]) == 0

    assert (tmp_path / "odd-rows.jpg").exists()


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


def test_a_picture_so_tall_that_a_robots_camera_would_show_the_horizon_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tall = tmp_path / "tall.png"
    cv2.imwrite(str(tall), np.full((8000, 64, 3), LEAF_BGR, np.uint8))

    assert run(["detect", str(tall), "--robot", "bonnbot"]) == 2

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
    crop.write_text(
        f"{text}finding: {{ method: moving_variance, window: 0.5, stride: 0.1, neighbours: 100 }}\n"
    )

    called = ["--crop", str(crop), "--robot", "bonnbot", "--overlay", str(tmp_path)]
    assert run(["detect", str(picture), *called, "--json"]) == 0

    assert isinstance(objects(capsys)[0]["rows"], list)


def test_a_folder_in_place_of_a_picture_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(tmp_path)]) == 2

    assert f"{tmp_path}: cannot be read" in error(capsys)


@pytest.mark.parametrize("options", [[], ["--robot", "bonnbot"]], ids=" ".join)
def test_a_picture_that_no_camera_takes_is_refused(
    options: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tiny = tmp_path / "tiny.png"
    cv2.imwrite(str(tiny), np.zeros((10, 20, 3), np.uint8))

    assert run(["detect", str(tiny), *options]) == 2

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
