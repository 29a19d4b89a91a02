"""Photographs near the robot's view: hits, misses, false alarms, and what is asked of none."""

from math import isnan
from pathlib import Path
from types import SimpleNamespace

import pytest

from fieldnav.errors import SettingsError
from fieldnav.evaluation.found_rows import Finder, FoundRows
from fieldnav.evaluation.near_nadir import near_nadir
from fieldnav.evaluation.near_nadir_score import Tally, score
from fieldnav.messages import Image, RowLine
from fieldnav.settings.crop import CropProfile, RowFinder
from fieldnav.settings.loading import load_crop

SIZE = (1000, 500)
TRUE = [RowLine(300, 200), RowLine(500, 500), RowLine(700, 800)]
ALL = [True, True, True]


def shifted(rows: list[RowLine], by_px: float) -> list[RowLine]:
    return [RowLine(row.x_top_px + by_px, row.x_bottom_px + by_px) for row in rows]


def counts(tally: Tally) -> tuple[int, int, int]:
    """Hits, misses, false alarms."""
    return len(tally.distance), tally.misses, tally.false_alarms


def values(folder: Path, find: Finder) -> dict[tuple[str, str], float]:
    figures, _ = near_nadir(folder, find, lambda part, done, steps: None)
    return {(figure.case, figure.metric): figure.value for figure in figures}


def test_true_rows_are_all_hits_without_error() -> None:
    tally = score(TRUE, TRUE, ALL, SIZE)

    assert counts(tally) == (3, 0, 0) and tally.f1 == 1
    assert tally.distance.max() == 0 and tally.turned_deg.max() == 0


@pytest.mark.parametrize(("by_px", "hits"), [(49, 3), (51, 0), (-49, 3), (-51, 0)])
def test_a_row_is_a_hit_below_a_twentieth_of_the_width(by_px: float, hits: int) -> None:
    assert counts(score(shifted(TRUE, by_px), TRUE, ALL, SIZE)) == (hits, 3 - hits, 3 - hits)


def test_the_upper_quarter_is_not_compared() -> None:
    # 100 px off at the top and right at the bottom: 37.5 px on average over the lower three quarters.
    tally = score([RowLine(600, 500)], TRUE[1:2], [True], SIZE)

    assert counts(tally) == (1, 0, 0)
    assert tally.distance[0] * SIZE[0] == pytest.approx(37.5, abs=0.2)


def test_the_angle_is_that_of_the_line_in_pixels() -> None:
    (turned,) = score([RowLine(510, 490)], TRUE[1:2], [True], SIZE).turned_deg

    assert turned == pytest.approx(2.295, abs=0.01)  # atan(20 / 499)


def test_two_reports_of_one_row_are_a_hit_and_a_false_alarm() -> None:
    assert counts(score([TRUE[0], *shifted(TRUE[:1], 5)], TRUE[:1], [True], SIZE)) == (1, 0, 1)


def test_a_row_that_need_not_be_found_is_no_miss() -> None:
    assert counts(score(TRUE[:2], TRUE, [True, True, False], SIZE)) == (2, 0, 0)


def test_finding_a_row_that_need_not_be_found_is_neither_hit_nor_false_alarm() -> None:
    tally = score(TRUE, TRUE, [True, True, False], SIZE)

    assert counts(tally) == (2, 0, 0) and tally.f1 == 1


def test_no_report_misses_every_row_that_must_be_found() -> None:
    tally = score([], TRUE, [True, True, False], SIZE)

    assert counts(tally) == (0, 2, 0) and tally.f1 == 0


@pytest.mark.parametrize("flag", ["p", "w"])
def test_partly_and_weakly_seen_rows_are_optional(flag: str, tmp_path: Path, photos: SimpleNamespace) -> None:
    rows = [(100.0, 60.0, "f"), (160.0, 160.0, flag)]
    folder = photos.near_nadir(tmp_path, rows=rows)

    without = values(folder, photos.finder([(100, 60)]))
    found = values(folder, photos.finder([(100, 60), (160, 160)]))

    assert without["near view, all", "F1"] == found["near view, all", "F1"] == 1


def test_each_crop_has_a_figure_and_all_have_one(tmp_path: Path, photos: SimpleNamespace) -> None:
    folder = photos.near_nadir(tmp_path, crops=("maize", "maize (early)", "soybean", "winter wheat"))
    one_missed = {"winter-wheat": photos.rows[:2]}

    value = values(folder, photos.finder(photos.rows, one_missed))

    assert value["near view, winter wheat", "F1"] == pytest.approx(0.8)
    assert [value[f"near view, {crop}", "F1"] for crop in ("maize", "maize (early)", "soybean")] == [1, 1, 1]
    assert value["near view, all", "F1"] == pytest.approx(2 * 11 / (2 * 11 + 1))
    assert value["near view, all", "matched rows within 2 degrees (%)"] == 100
    assert value["near view, all", "mean position error (% of width)"] == 0


def test_position_and_angle_are_of_the_rows_matched(tmp_path: Path, photos: SimpleNamespace) -> None:
    folder = photos.near_nadir(tmp_path)
    # The first row 4 px to the side, the second turned by 16 px over the height, which is 3.8 degrees.
    value = values(folder, photos.finder([(104, 64), (168, 152), (10, 10)]))

    assert value["near view, all", "matched rows within 2 degrees (%)"] == 50
    off_px = (
        4 + 10 / 3
    ) / 2  # the second is off by 8 px at the bottom, by 0 in the middle, by 4 at a quarter
    assert value["near view, all", "mean position error (% of width)"] == pytest.approx(
        off_px / 3.2, rel=0.01
    )


def test_a_doubtful_row_is_not_reported_but_its_confidence_is_judged(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = photos.near_nadir(tmp_path)
    doubtful = [(*row, 0.9) for row in photos.rows] + [(20, 20, 0.3)]

    figures, judged = near_nadir(folder, photos.finder(doubtful), lambda part, done, steps: None)

    assert figures[0].value == 1
    assert judged.confidence.tolist() == [0.9, 0.9, 0.9, 0.3]
    assert judged.right.tolist() == [True, True, True, False]


def test_the_papers_finder_is_run_beside_ours(tmp_path: Path, photos: SimpleNamespace) -> None:
    asked: list[tuple[str, RowFinder]] = []

    def find(image: Image, crop: CropProfile | None) -> FoundRows:
        assert crop is not None and image.shape == (240, 320, 3)
        asked.append((crop.name, crop.finding.method))
        papers = crop.finding.method is RowFinder.MOVING_VARIANCE and len(asked) > 1
        return photos.found(photos.rows[:2] if papers else photos.rows)

    value = values(photos.near_nadir(tmp_path, crops=("maize (early)",)), find)

    assert asked == [("maize", load_crop("maize").finding.method), ("maize", RowFinder.MOVING_VARIANCE)]
    assert value["near view, all", "F1"] == 1
    assert value["near view, all (moving variance)", "F1"] == pytest.approx(0.8)
    assert value["near view, maize (early) (moving variance)", "F1"] == pytest.approx(0.8)


def test_no_hit_at_all_has_no_position_error(tmp_path: Path, photos: SimpleNamespace) -> None:
    value = values(photos.near_nadir(tmp_path), photos.finder([]))

    assert value["near view, all", "F1"] == 0
    assert isnan(value["near view, all", "mean position error (% of width)"])


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("{", "is no JSON"),
        ("[]", "is no JSON object"),
        ('{"0.jpg": {"crop": 5, "rows": []}}', "0.jpg: crop"),
        ('{"0.jpg": {"crop": "maize", "rows": [{"x_top": "left", "x_bottom": 2, "flag": "f"}]}}', "x_top"),
        ('{"0.jpg": {"crop": "maize"}}', "rows: is missing"),
    ],
)
def test_wrong_ground_truth_is_said_in_one_line(
    content: str, said: str, tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = photos.near_nadir(tmp_path)
    (folder / "rows.json").write_text(content, encoding="utf-8")

    with pytest.raises(SettingsError, match=said) as error:
        values(folder, photos.finder([]))

    assert str(folder / "rows.json") in str(error.value) and "\n" not in str(error.value)


def test_a_photograph_that_is_missing_or_broken_is_named(tmp_path: Path, photos: SimpleNamespace) -> None:
    folder = photos.near_nadir(tmp_path)
    picture = folder / "images" / "0.jpg"
    picture.write_bytes(b"no picture")
    with pytest.raises(SettingsError, match=r"0\.jpg: is no whole picture"):
        values(folder, photos.finder([]))

    picture.unlink()
    with pytest.raises(SettingsError, match=r"0\.jpg: there is no such file"):
        values(folder, photos.finder([]))
