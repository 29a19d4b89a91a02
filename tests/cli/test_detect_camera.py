"""`fieldnav detect`: where the camera is, and who says so."""

import re
from collections.abc import Callable
from math import degrees, tan
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run

Objects = Callable[[], list[dict[str, Any]]]
CAMERA_KEYS = {"estimated", "tilt_deg", "height_m", "horizon_px"}


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
    tmp_path: Path, capsys: pytest.CaptureFixture[str], plots: SimpleNamespace
) -> None:
    cv2.imwrite(str(tmp_path / "bare.png"), np.full((72, 128, 3), plots.soil_bgr, np.uint8))

    assert run(["detect", str(tmp_path / "bare.png")]) == 0

    assert "bare.png: no row, 128x72" in (out := capsys.readouterr().out)
    assert "camera unknown" in out


def test_an_unknown_camera_is_estimated_near_the_one_that_took_the_picture(
    picture: Path, plots: SimpleNamespace, objects: Objects
) -> None:
    taken = plots.camera(1280, 720)

    assert run(["detect", str(picture), "--crop", "sugar-beet", "--json"]) == 0

    told = objects()[0]["camera"]
    assert isinstance(told, dict) and told["estimated"] is True
    assert told["tilt_deg"] == pytest.approx(degrees(taken.tilt_rad), abs=8)
    assert told["height_m"] == pytest.approx(taken.height_m, rel=0.15)
    assert told["horizon_px"] < 0


def test_without_a_crop_the_cameras_height_is_unknown(picture: Path, objects: Objects) -> None:
    assert run(["detect", str(picture), "--json"]) == 0

    told = objects()[0]["camera"]
    assert isinstance(told, dict)
    assert told["estimated"] is True and told["height_m"] is None and told["tilt_deg"] > 0


def test_without_rows_nothing_is_said_of_the_camera(
    tmp_path: Path, plots: SimpleNamespace, objects: Objects
) -> None:
    cv2.imwrite(str(tmp_path / "bare.png"), np.full((72, 128, 3), plots.soil_bgr, np.uint8))

    assert run(["detect", str(tmp_path / "bare.png"), "--json"]) == 0

    assert objects()[0]["camera"] == dict.fromkeys(CAMERA_KEYS) | {"estimated": True}


def test_a_robots_camera_is_taken_from_its_file(
    picture: Path, plots: SimpleNamespace, objects: Objects
) -> None:
    taken = plots.camera(1280, 720)

    assert run(["detect", str(picture), "--robot", "bonnbot", "--json"]) == 0

    horizon_px = taken.centre_y_px - taken.focal_px * tan(taken.tilt_rad)
    assert objects()[0]["camera"] == {
        "estimated": False,
        "tilt_deg": 65.0,
        "height_m": 1.0,
        "horizon_px": pytest.approx(horizon_px, abs=0.06),
    }
