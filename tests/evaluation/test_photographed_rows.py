"""The sets of photographs together: what is there is measured, what is not is said."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from fieldnav.evaluation.benchmark import Plan, Report
from fieldnav.evaluation.photographed_rows import photographed_rows
from fieldnav.evaluation.reliability import CASE


def measured(plan: Plan, photos: SimpleNamespace, lines: list[tuple[float, ...]]) -> Report:
    return photographed_rows(plan, lambda part, done, steps: None, photos.finder(lines))


def test_without_a_folder_every_set_is_left_out_and_the_reason_said(photos: SimpleNamespace) -> None:
    report = measured(Plan(None, quick=False), photos, [])

    assert report.figures == ()
    near, crbd, lincoln, reliability = report.left_out
    assert near.part == "photographs near the robot's view" and "--data" in near.reason
    assert crbd.part == "Crop Row Benchmark Dataset" and "FIELDNAV_DATA" in crbd.reason
    assert lincoln.part == "Crop Row Detection Lincoln Dataset" and "--data" in lincoln.reason
    assert reliability.part == CASE


@pytest.mark.parametrize(
    ("there", "absent"),
    [
        ("near_nadir", ("crbd", "crdld")),
        ("crbd", ("near_nadir_jw", "crdld")),
        ("lincoln", ("near_nadir_jw", "crbd")),
    ],
    ids=["near nadir alone", "crbd alone", "lincoln alone"],
)
def test_a_set_that_is_absent_is_left_out_and_named(
    there: str, absent: tuple[str, str], tmp_path: Path, photos: SimpleNamespace
) -> None:
    getattr(photos, there)(tmp_path)

    report = measured(Plan(tmp_path, quick=False), photos, [(160, 160)])

    assert [part.reason for part in report.left_out] == [
        f"there is no folder {tmp_path / name}" for name in absent
    ]
    assert report.figures


def test_the_confidence_is_judged_over_all_sets(tmp_path: Path, photos: SimpleNamespace) -> None:
    photos.near_nadir(tmp_path)
    photos.crbd(tmp_path)
    photos.lincoln(tmp_path, [[(160, 128), (160, 511)], [(180, 128), (180, 511)]])

    # The first row is a true one in all sets, the other in none but the last.
    report = measured(Plan(tmp_path, quick=False), photos, [(160, 160, 0.95), (182, 182, 0.15)])

    shares = {figure.metric: figure.value for figure in report.figures if figure.case == CASE}
    assert shares["share right of rows given 0.9 to 1.0"] == 1
    assert shares["share right of rows given 0.1 to 0.2"] == pytest.approx(1 / 3)
    assert shares["expected calibration error"] == pytest.approx((0.05 + (1 / 3 - 0.15)) / 2)
    assert report.left_out == ()


def test_the_confidence_is_judged_over_each_set_by_itself(tmp_path: Path, photos: SimpleNamespace) -> None:
    photos.near_nadir(tmp_path)
    photos.lincoln(tmp_path, [[(160, 128), (160, 511)], [(180, 128), (180, 511)]])

    report = measured(Plan(tmp_path, quick=False), photos, [(160, 160, 0.95), (182, 182, 0.15)])

    doubtful = {
        figure.case: figure.value for figure in report.figures if figure.metric.endswith("given 0.1 to 0.2")
    }
    assert doubtful == {
        f"{CASE}: photographs near the robot's view": 0,
        f"{CASE}: Crop Row Detection Lincoln Dataset": 1,
        CASE: 0.5,
    }


def test_the_picture_is_drawn_where_it_is_asked_for(tmp_path: Path, photos: SimpleNamespace) -> None:
    photos.crbd(tmp_path)

    measured(Plan(tmp_path, quick=False, plots=tmp_path), photos, [(160, 160)])

    assert (tmp_path / "reliability.png").exists()


def test_nothing_found_is_said_and_nothing_drawn(tmp_path: Path, photos: SimpleNamespace) -> None:
    photos.crbd(tmp_path)

    report = measured(Plan(tmp_path, quick=False, plots=tmp_path), photos, [])

    assert [part.part for part in report.left_out][-1] == CASE
    assert not (tmp_path / "reliability.png").exists()
