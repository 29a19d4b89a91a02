"""`fieldnav detect`: rows of pictures as JSON, as a table, as curves, whatever the picture."""

import re
from collections.abc import Callable
from importlib.resources import files
from math import atan2, degrees, radians
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run
from fieldnav.pinhole import Pinhole

Objects = Callable[[], list[dict[str, Any]]]
BEND_RADIUS_M = 12.0
CAMERA_KEYS = {"estimated", "tilt_deg", "height_m", "horizon_px"}


@pytest.mark.parametrize("options", [["--robot", "bonnbot"], ["--crop", "sugar-beet"], []], ids=" ".join)
@pytest.mark.parametrize("size", [(1280, 720), (640, 480), (320, 240), (1920, 1080)])
def test_rows_are_found_whatever_the_pictures_size(
    size: tuple[int, int], options: list[str], tmp_path: Path, plots: SimpleNamespace, objects: Objects
) -> None:
    view, path = plots.camera(*size), tmp_path / "field.png"
    cv2.imwrite(str(path), plots.field(view))

    assert run(["detect", str(path), *options, "--json"]) == 0

    (found,) = objects()
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
    picture: Path, tmp_path: Path, plots: SimpleNamespace, objects: Objects
) -> None:
    bare = tmp_path / "bare.png"
    cv2.imwrite(str(bare), np.full((720, 1280, 3), plots.soil_bgr, np.uint8))

    assert run(["detect", str(bare), str(picture), str(bare), "--json"]) == 0

    found = objects()
    assert [each["image"] for each in found] == [str(bare), str(picture), str(bare)]
    assert found[0]["rows"] == found[2]["rows"] == []
    assert set(found[1]) == {"image", "width", "height", "rows", "camera", "field", "milliseconds"}
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


@pytest.mark.parametrize("options", [[], ["--robot", "bonnbot"]], ids=" ".join)
def test_straight_rows_have_points_along_their_lines(
    options: list[str], picture: Path, objects: Objects
) -> None:
    assert run(["detect", str(picture), *options, "--json"]) == 0

    rows = objects()[0]["rows"]
    assert isinstance(rows, list) and rows
    for row in rows:
        x, y = np.array(row["points"]).T
        assert len(x) == 9 and (y[0], y[-1]) == (0, 719) and (np.diff(y) > 0).all()
        line = row["x_top"] + (row["x_bottom"] - row["x_top"]) * y / 719
        assert np.abs(x - line).max() < 0.01 * 1280


def test_curved_rows_have_points_along_their_curves(
    tmp_path: Path, plots: SimpleNamespace, objects: Objects
) -> None:
    ahead = Pinhole(640, 480, 480.0, 1.2, radians(35), 0.0)
    path = tmp_path / "bend.png"
    cv2.imwrite(str(path), plots.field(ahead, 1 / BEND_RADIUS_M, furthest_m=9.0, rows=9))

    assert run(["detect", str(path), "--json"]) == 0

    rows = objects()[0]["rows"]
    assert isinstance(rows, list) and rows
    row = min(rows, key=lambda each: abs(each["x_bottom"] - 320))
    x, y = np.array(row["points"]).T
    distance_m = np.arange(0.5, 9.0, 0.01)
    bend = np.stack([distance_m, distance_m**2 / 2 / BEND_RADIUS_M], axis=-1)
    true = ahead.to_image(bend)[::-1]
    seen = y > 60
    off = x - np.interp(y, true[:, 1], true[:, 0])
    assert np.abs(off[y > 130]).max() < 0.02 * 640
    straight = row["x_top"] + (row["x_bottom"] - row["x_top"]) * y / 479
    assert np.abs(x - straight)[seen].max() > 0.01 * 640, "the line alone would not tell of the bend"


def test_a_picture_is_named_as_it_was_typed(
    picture: Path, monkeypatch: pytest.MonkeyPatch, objects: Objects, error: Callable[[], str]
) -> None:
    monkeypatch.chdir(picture.parent)

    assert run(["detect", "./field.png", "--json"]) == 0
    assert objects()[0]["image"] == "./field.png"
    assert run(["detect", "./none.png"]) == 2
    assert error() == "error: ./none.png: there is no such file"


def test_a_window_so_wide_that_it_has_few_places_finds_rows_or_none(
    picture: Path, tmp_path: Path, objects: Objects
) -> None:
    crop = tmp_path / "mine.yaml"
    text = (files("config") / "crops" / "sugar-beet.yaml").read_text(encoding="utf-8")
    crop.write_text(
        f"{text}finding: {{ method: moving_variance, window: 0.5, stride: 0.1, neighbours: 100 }}\n"
    )

    called = ["--crop", str(crop), "--robot", "bonnbot", "--overlay", str(tmp_path)]
    assert run(["detect", str(picture), *called, "--json"]) == 0

    assert isinstance(objects()[0]["rows"], list)
