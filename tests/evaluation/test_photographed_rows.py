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
    near, crbd, reliability = report.left_out
    assert near.part == "photographs near the robot's view" and "--data" in near.reason
    assert crbd.part == "Crop Row Benchmark Dataset" and "FIELDNAV_DATA" in crbd.reason
    assert reliability.part == CASE


@pytest.mark.parametrize(
    ("there", "absent"), [("near_nadir", "crbd"), ("crbd", "near_nadir_jw")], ids=["no crbd", "no near nadir"]
)
def test_a_set_that_is_absent_is_left_out_and_named(
    there: str, absent: str, tmp_path: Path, photos: SimpleNamespace
) -> None:
    getattr(photos, there)(tmp_path)

    report = measured(Plan(tmp_path, quick=False), photos, [(160, 160)])

    (left_out,) = report.left_out
    assert left_out.reason == f"there is no folder {tmp_path / absent}"
    assert report.figures


def test_the_confidence_is_judged_over_both_sets(tmp_path: Path, photos: SimpleNamespace) -> None:
    photos.near_nadir(tmp_path)
    photos.crbd(tmp_path)

    # The middle row is a true one in both sets, the other in none.
    report = measured(Plan(tmp_path, quick=False), photos, [(160, 160, 0.95), (182, 182, 0.15)])

    shares = {figure.metric: figure.value for figure in report.figures if figure.case == CASE}
    assert shares["share right of rows given 0.9 to 1.0"] == 1
    assert shares["share right of rows given 0.1 to 0.2"] == 0
    assert shares["expected calibration error"] == pytest.approx(0.1)
    assert report.left_out == ()


def test_the_picture_is_drawn_where_it_is_asked_for(tmp_path: Path, photos: SimpleNamespace) -> None:
    photos.crbd(tmp_path)

    measured(Plan(tmp_path, quick=False, plots=tmp_path), photos, [(160, 160)])

    assert (tmp_path / "reliability.png").exists()


def test_nothing_found_is_said_and_nothing_drawn(tmp_path: Path, photos: SimpleNamespace) -> None:
    photos.crbd(tmp_path)

    report = measured(Plan(tmp_path, quick=False, plots=tmp_path), photos, [])

    assert [part.part for part in report.left_out][-1] == CASE
    assert not (tmp_path / "reliability.png").exists()
