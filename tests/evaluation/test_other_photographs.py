"""The benchmark on photographs of one's own: other sizes and suffixes, and only some of the parts."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Plan
from fieldnav.evaluation.crbd_truth import pictures_in
from fieldnav.evaluation.detection import unposed_rows
from fieldnav.evaluation.near_nadir import near_nadir
from fieldnav.evaluation.photographed_rows import photographed_rows
from fieldnav.evaluation.photographs import PhotographSet, read_photograph

NO_BAR = lambda part, done, steps: None  # noqa: E731 - what a benchmark tells where nobody watches


def write_truth(folder: Path, entries: object) -> Path:
    path = folder / "near_nadir_jw" / "rows.json"
    path.parent.mkdir(parents=True)
    path.write_text(json.dumps(entries), encoding="utf-8")
    return path


@pytest.mark.parametrize("size", [(1, 1), (20, 300), (640, 360)])
def test_a_photograph_of_any_size_is_judged_by_the_real_finder(
    size: tuple[int, int], tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = photos.near_nadir(tmp_path)
    photos.picture(folder / "images" / "0.jpg", size)

    figures, judged = near_nadir(folder, unposed_rows, NO_BAR)

    assert figures[0].value == 0 and len(judged) == 0, "one grey has no rows"


@pytest.mark.parametrize(
    ("entries", "said"),
    [
        ({"_meta": {}}, "names no photograph; allowed is one key a photograph"),
        ({"0.jpg": 5}, r"0\.jpg: 5 is not allowed; allowed is a group of the keys crop, rows"),
        ({"0.jpg": {"crop": "", "rows": []}}, r"0\.jpg: crop: '' is not allowed"),
        (
            {"0.jpg": {"crop": "maize", "rows": [{"x_top": 1e300, "x_bottom": 2, "flag": "f"}]}},
            "x_top: 1e.300",
        ),
        ({"0.jpg": {"crop": "maize", "rows": [{"x_top": 1, "x_bottom": 2, "flag": "q"}]}}, "flag: 'q'"),
    ],
)
def test_rows_that_make_no_sense_are_refused_in_one_line(entries: object, said: str, tmp_path: Path) -> None:
    path = write_truth(tmp_path, entries)

    with pytest.raises(SettingsError, match=said) as error:
        near_nadir(path.parent, unposed_rows, NO_BAR)

    assert str(error.value).startswith(f"{path}: ") and "\n" not in str(error.value)


def test_brackets_without_end_are_no_json(tmp_path: Path) -> None:
    path = write_truth(tmp_path, {})
    path.write_text("[" * 200_000, encoding="utf-8")

    with pytest.raises(SettingsError, match=r"rows\.json: is no JSON"):
        near_nadir(path.parent, unposed_rows, NO_BAR)


def test_a_mark_that_an_editor_puts_before_the_text_is_passed_over(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = photos.near_nadir(tmp_path)
    path = folder / "rows.json"
    path.write_text(path.read_text(encoding="utf-8"), encoding="utf-8-sig")

    assert near_nadir(folder, photos.finder(photos.rows), NO_BAR)[0][0].value == 1


@pytest.mark.parametrize("suffix", [".JPG", ".jpeg", ".png"])
def test_pictures_of_the_crop_row_set_may_have_other_suffixes(
    suffix: str, tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = photos.crbd(tmp_path)
    path = folder / "images" / "crop_row_000.jpg"
    path.rename(path.with_suffix(suffix))

    (picture,) = pictures_in(folder)

    assert read_photograph(picture.path).shape == (240, 320, 3)


@pytest.mark.parametrize(
    ("line", "said"), [("0\t1e-9", "d: 1e-09: allowed is 1 px"), ("-1e9\t40", "c: 1e.09: allowed is 3200 px")]
)
def test_a_lattice_of_rows_beyond_number_is_refused(
    line: str, said: str, tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = photos.crbd(tmp_path)
    (folder / "gt" / "crop_row_000.crp").write_text(line, encoding="utf-8")

    with pytest.raises(SettingsError, match=said):
        pictures_in(folder)


@pytest.mark.parametrize(
    ("part", "folder"), [("rows.json", "near_nadir_jw"), ("gt", "crbd"), ("rows.json", "crdld")]
)
def test_a_set_without_its_ground_truth_is_left_out_and_the_others_measured(
    part: str, folder: str, tmp_path: Path, photos: SimpleNamespace
) -> None:
    photos.near_nadir(tmp_path)
    photos.crbd(tmp_path)
    photos.lincoln(tmp_path)
    (tmp_path / folder / part).rename(tmp_path / "away")

    report = photographed_rows(Plan(tmp_path, quick=False), NO_BAR, photos.finder(photos.rows))

    assert [part.reason for part in report.left_out] == [f"there is no {tmp_path / folder / part}"]
    assert report.figures


@pytest.mark.parametrize("photographs", PhotographSet)
def test_a_file_in_place_of_a_set_is_no_set(photographs: PhotographSet, tmp_path: Path) -> None:
    (tmp_path / photographs.value).touch()
    plan = Plan(tmp_path, quick=False)

    assert photographs.folder(plan) is None
    assert photographs.absence(plan).reason == f"there is no folder {tmp_path / photographs.value}"
