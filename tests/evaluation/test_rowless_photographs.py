"""Photographs without a row: which are looked at, with what known, and what is left out."""

from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Plan
from fieldnav.evaluation.detection import unposed_rows
from fieldnav.evaluation.found_rows import FoundRows
from fieldnav.evaluation.rendered_rows import CROPS
from fieldnav.evaluation.rendered_scene import Place, Scene
from fieldnav.evaluation.rowless_photographs import KNOWN, POSE_UNKNOWN, UNKNOWN, rowless_photographs
from fieldnav.messages import Image, Side
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.plan import sow

NO_BAR = lambda part, done, steps: None  # noqa: E731 - what a benchmark tells where nobody watches
SMALL = (64, 48)


def test_a_set_that_is_absent_is_left_out_in_one_line(tmp_path: Path) -> None:
    (nowhere,) = rowless_photographs(Plan(None, quick=False), NO_BAR, unposed_rows).left_out
    (absent,) = rowless_photographs(Plan(tmp_path, quick=False), NO_BAR, unposed_rows).left_out

    assert nowhere.part == absent.part == "photographs without a row"
    assert "--data" in nowhere.reason and absent.reason == f"there is no folder {tmp_path / 'no_rows'}"


def test_a_folder_that_is_absent_or_empty_is_left_out_and_the_other_measured(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    photos.picture(tmp_path / "no_rows" / "fields" / "soil.jpg", SMALL)
    absent = rowless_photographs(Plan(tmp_path, quick=False), NO_BAR, photos.finder([]))
    (tmp_path / "no_rows" / "photographs").mkdir()
    empty = rowless_photographs(Plan(tmp_path, quick=False), NO_BAR, photos.finder([]))

    folder = tmp_path / "no_rows" / "photographs"
    assert [part.reason for part in absent.left_out] == [f"there is no {folder}"]
    assert [part.reason for part in empty.left_out] == [f"{folder} holds no picture"]
    assert len(absent.figures) == len(empty.figures) == 3


def test_the_share_with_a_row_is_measured_without_a_camera_and_with_one(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    """Grey pictures, in a third of which the finder for unknown cameras is made to report a row."""
    for number in range(3):
        photos.picture(tmp_path / "no_rows" / "photographs" / f"{number}.jpg", (64, 48 + number))
    photos.picture(tmp_path / "no_rows" / "fields" / "soil.png", SMALL)

    def find(image: Image, crop: CropProfile | None) -> FoundRows:
        assert crop is None
        return photos.found([(30, 30, 0.9)] if len(image) == 49 else [(30, 30, 0.4)])

    figures = rowless_photographs(Plan(tmp_path, quick=False), NO_BAR, find).figures

    assert [(figure.metric, round(figure.value, 1), figure.met) for figure in figures] == [
        (UNKNOWN, 33.3, False),
        (KNOWN, 0, True),
        (POSE_UNKNOWN, 0, True),
    ] + [(metric, 0, True) for metric in (UNKNOWN, KNOWN, POSE_UNKNOWN)]
    assert [figure.best_known for figure in figures] == [3.0] * 3 + [None] * 3
    assert {figure.goal for figure in figures} == {2.0}
    assert {figure.case for figure in figures} == {
        "no rows: ordinary photographs, 3 images",
        "no rows: soil, verges, stubble, sky, 1 images",
    }


def test_a_row_that_shows_is_reported_with_the_camera_known(tmp_path: Path) -> None:
    crop = load_crop(CROPS[0])
    field = revised(load_field("demo"), {"length_m": 12.0, "crop": crop.name})
    tilt_rad = load_robot("bonnbot").cameras.front.pinhole().tilt_rad
    scene = Scene(field, crop, sow(field, crop, Side.RIGHT))
    shot = scene.shoot(Place(0, 6.0), tilt_rad, np.random.default_rng(1))
    folder = tmp_path / "no_rows" / "photographs"
    folder.mkdir(parents=True)
    cv2.imwrite(str(folder / "rows.png"), shot.image)

    figures = rowless_photographs(Plan(tmp_path, quick=False), NO_BAR, unposed_rows).figures

    assert [figure.value for figure in figures] == [100.0] * 3


def test_folders_within_are_searched_and_what_is_no_picture_is_passed_over(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    fields = tmp_path / "no_rows" / "fields"
    photos.picture(fields / "soil" / "bare" / "1.png", SMALL)
    photos.picture(fields / "2.JPG", SMALL)
    photos.picture(fields / ".3.jpg", SMALL)
    (fields / "README.md").write_text("two pictures", encoding="utf-8")

    figures = rowless_photographs(Plan(tmp_path, quick=False), NO_BAR, photos.finder([])).figures

    assert {figure.case for figure in figures} == {"no rows: soil, verges, stubble, sky, 2 images"}


def test_a_quick_run_takes_every_tenth_picture(tmp_path: Path, photos: SimpleNamespace) -> None:
    for number in range(11):
        photos.picture(tmp_path / "no_rows" / "photographs" / f"{number:02}.jpg", SMALL)
    told: list[tuple[int, int]] = []

    figures = rowless_photographs(
        Plan(tmp_path, quick=True), lambda part, *at: told.append(at), photos.finder([])
    ).figures

    assert figures[0].case.endswith("2 images")
    assert told == [(0, 2), (1, 2), (2, 2)]


def test_a_broken_picture_is_named(tmp_path: Path) -> None:
    broken = tmp_path / "no_rows" / "photographs" / "car.jpg"
    broken.parent.mkdir(parents=True)
    broken.write_bytes(b"no picture")

    with pytest.raises(SettingsError, match=r"photographs/car\.jpg: is no whole picture"):
        rowless_photographs(Plan(tmp_path, quick=False), NO_BAR, unposed_rows)
