"""The Lincoln set: its figures, what joins the reliability of confidence, and wrong ground truth."""

from math import isnan
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Figure
from fieldnav.evaluation.detection import unposed_rows
from fieldnav.evaluation.found_rows import Finder, FoundRows
from fieldnav.evaluation.lincoln import lincoln, pictures_in
from fieldnav.messages import Image, RowLine
from fieldnav.settings.crop import CropProfile

NO_BAR = lambda part, done, steps: None  # noqa: E731 - what a benchmark tells where nobody watches
ROWS = (((100, 128), (100, 511)), ((250, 128), (260, 320), (250, 511)), ((400, 128), (400, 511)))


def finder(*curves: tuple[float, ...]) -> Finder:
    """Reports curves, each by x at the top, in the middle, at the bottom, and its confidence."""

    def find(image: Image, crop: CropProfile | None) -> FoundRows:
        assert crop is None and image.shape == (512, 512, 3)
        lines = tuple(RowLine(top, bottom, confidence) for top, _, bottom, confidence in curves)
        paths = [[(top, 128), (middle, 320), (bottom, 511)] for top, middle, bottom, _ in curves]
        return FoundRows(lines, np.array(paths, dtype=np.float64).reshape(-1, 3, 2))

    return find


def by_metric(figures: list[Figure]) -> dict[str, Figure]:
    return {figure.metric: figure for figure in figures}


def test_all_rows_found_reach_every_goal_and_the_best_known_stands_beside_them(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    exact = finder((100, 100, 100, 0.9), (250, 260, 250, 0.9), (400, 400, 400, 0.9))

    figures, judged = lincoln(photos.lincoln(tmp_path, ROWS), exact, NO_BAR, quick=False)

    assert {metric: (figure.value, figure.best_known) for metric, figure in by_metric(figures).items()} == {
        "F1": (1, 0.864),
        "recall": (1, 0.83),
        "precision": (1, 0.90),
        "matched rows within 2 degrees (%)": (100, 83),
        "mean position error (% of width)": (0, None),
    }
    assert [figure.goal for figure in figures] == [0.90, None, 0.95, 85.0, None]
    assert {figure.case for figure in figures} == {"Crop Row Detection Lincoln Dataset, 1 images"}
    assert judged.right.tolist() == [True] * 3


def test_misses_false_alarms_angles_and_positions_are_over_all_pictures(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    leaning = finder((90, 100, 110, 0.9), (180, 180, 180, 0.9), (405.12, 405.12, 405.12, 0.9))

    figures, judged = lincoln(photos.lincoln(tmp_path, ROWS, count=2), leaning, NO_BAR, quick=False)

    value = {metric: figure.value for metric, figure in by_metric(figures).items()}
    assert (value["recall"], value["precision"]) == (pytest.approx(2 / 3), pytest.approx(2 / 3))
    assert value["F1"] == pytest.approx(2 / 3)
    assert value["matched rows within 2 degrees (%)"] == 50, "20 px over 383 px are 3 degrees"
    assert value["mean position error (% of width)"] == pytest.approx((1 + 5 / 5.12) / 2, abs=0.01)
    assert judged.right.tolist() == [True, False, True] * 2


def test_a_doubtful_row_is_not_reported_but_its_confidence_is_judged(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    doubtful = finder((100, 100, 100, 0.4), (180, 180, 180, 0.3), (400, 400, 400, 0.5), (-99, -99, -99, 0.2))

    figures, judged = lincoln(photos.lincoln(tmp_path, ROWS), doubtful, NO_BAR, quick=False)

    assert by_metric(figures)["recall"].value == pytest.approx(1 / 3)
    assert by_metric(figures)["precision"].value == 1
    assert judged.confidence.tolist() == [0.4, 0.3, 0.5], "a row beside all annotated ones is not judged"
    assert judged.right.tolist() == [True, False, True]


def test_nothing_found_is_a_figure_too(tmp_path: Path, photos: SimpleNamespace) -> None:
    figures, judged = lincoln(photos.lincoln(tmp_path, ROWS), unposed_rows, NO_BAR, quick=False)

    assert by_metric(figures)["F1"].value == 0, "one grey has no rows"
    assert isnan(by_metric(figures)["precision"].value) and figures[2].met is False
    assert len(judged) == 0


def test_a_quick_run_takes_every_tenth_picture_and_says_how_many(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    told: list[tuple[int, int]] = []

    figures, _ = lincoln(
        photos.lincoln(tmp_path, ROWS, count=11), finder(), lambda part, *at: told.append(at), quick=True
    )

    assert figures[0].case.endswith("2 images")
    assert told == [(0, 2), (1, 2), (2, 2)]


def test_the_annotated_rows_are_read_as_curves(tmp_path: Path, photos: SimpleNamespace) -> None:
    (picture,) = pictures_in(photos.lincoln(tmp_path, ROWS))

    assert picture.path == tmp_path / "crdld" / "images" / "0.jpg"
    assert [row.tolist() for row in picture.rows] == [[list(point) for point in row] for row in ROWS]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("{", "is no JSON"),
        ("[]", "is no JSON object; allowed is one key a picture"),
        ('{"_meta": {}}', "names no picture; allowed is one key a picture"),
        ('{"0.jpg": 5}', r"0\.jpg: rows: 5 is not allowed"),
        ('{"0.jpg": [[[1, 200]]]}', r"0\.jpg: rows\.0: \[\[1, 200\]\] is not allowed"),
        ('{"0.jpg": [[[1, 200], [2]]]}', r"0\.jpg: rows\.0\.1\.1: is missing"),
        ('{"0.jpg": [[[1, 200], ["left", 300]]]}', r"0\.jpg: rows\.0\.1\.0: 'left' is not allowed"),
        ('{"0.jpg": [[[1, 200], [2, 513]]]}', r"0\.jpg: rows\.0\.1\.1: 513 is not allowed; allowed is a num"),
        ('{"0.jpg": [[[1e300, 200], [2, 300]]]}', r"rows\.0\.0\.0: 1e\+300 is not allowed"),
        ('{"0.jpg": [[[1, 200], [9, 200.5]]]}', r"rows: .*: row 0 spans less than 1 px in y"),
        ('{"0.jpg": [], "0.jpg": []}', r"0\.jpg: is given twice"),
    ],
)
def test_wrong_ground_truth_is_said_in_one_line(
    content: str, said: str, tmp_path: Path, photos: SimpleNamespace
) -> None:
    path = photos.lincoln(tmp_path) / "rows.json"
    path.write_text(content, encoding="utf-8")

    with pytest.raises(SettingsError, match=said) as error:
        lincoln(path.parent, finder(), NO_BAR, quick=False)

    assert str(error.value).startswith(f"{path}: ") and "\n" not in str(error.value)


def test_a_picture_of_another_size_or_none_is_refused(tmp_path: Path, photos: SimpleNamespace) -> None:
    folder = photos.lincoln(tmp_path)
    picture = folder / "images" / "0.jpg"
    photos.picture(picture, (640, 480))
    with pytest.raises(SettingsError, match=r"0\.jpg: size: 640x480: allowed is 512x512"):
        lincoln(folder, finder(), NO_BAR, quick=False)

    picture.unlink()
    with pytest.raises(SettingsError, match=r"0\.jpg: there is no such file"):
        lincoln(folder, finder(), NO_BAR, quick=False)
