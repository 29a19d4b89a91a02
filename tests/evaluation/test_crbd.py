"""CRDA against detections whose score is known, the files, and which rows are right."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.errors import SettingsError
from fieldnav.evaluation.crbd import crbd
from fieldnav.evaluation.crbd_score import LOWER_HALF_PX, crda, positions, true_rows
from fieldnav.evaluation.crbd_truth import TrueLattice, pictures_in, read_truth
from fieldnav.evaluation.found_rows import UNMATCHED
from fieldnav.messages import Floats

HEIGHT, CENTRE, SPACING = 240, 160.0, 40.0


def upright() -> TrueLattice:
    """Rows every 40 px, one of them in the middle."""
    return TrueLattice(np.zeros(HEIGHT), np.full(HEIGHT, SPACING))


def fanning() -> TrueLattice:
    """Rows that bend and spread downwards."""
    down = np.arange(HEIGHT) / HEIGHT
    return TrueLattice(12 * down**2, 20 + 30 * down)


def rows_of(truth: TrueLattice, *index: int) -> Floats:
    return np.array([truth.offset_px + k * truth.spacing_px + CENTRE for k in index])


@pytest.mark.parametrize("truth", [upright(), fanning()], ids=["upright", "fanning"])
@pytest.mark.parametrize("first_row", [0, LOWER_HALF_PX])
def test_a_perfect_detection_scores_one(truth: TrueLattice, first_row: int) -> None:
    assert crda(rows_of(truth, -1, 0, 1), truth, first_row) == pytest.approx(1.0)


@pytest.mark.parametrize(("shift", "score"), [(0.05, 0.75), (-0.05, 0.75), (0.02, 0.96), (0.1, 0.0)])
@pytest.mark.parametrize("truth", [upright(), fanning()], ids=["upright", "fanning"])
def test_a_shift_costs_by_its_square(truth: TrueLattice, shift: float, score: float) -> None:
    found = rows_of(truth, -1, 0, 1) + shift * truth.spacing_px

    assert crda(found, truth) == pytest.approx(score)


def test_one_row_of_three_off_costs_its_third() -> None:
    found = rows_of(upright(), -1, 0, 1)
    found[2] += SPACING / 2

    assert crda(found, upright()) == pytest.approx(2 / 3)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_fewer_than_three_rows_score_nothing(count: int) -> None:
    assert crda(rows_of(upright(), -1, 0)[:count], upright()) == 0


def test_a_shift_by_whole_rows_costs_nothing() -> None:
    assert crda(rows_of(upright(), 1, 2, 3), upright()) == pytest.approx(1.0)


def test_the_group_is_the_best_over_the_whole_picture_not_of_each_image_row() -> None:
    jumping = rows_of(upright(), -1, 0, 1)
    jumping[:, : HEIGHT // 4] += SPACING

    assert crda(jumping, upright()) == pytest.approx(0.75)


def test_the_three_neighbours_about_the_centre_count_in_any_order() -> None:
    found = rows_of(upright(), 3, -1, 0, 2, 1)
    found[[0, 3]] += SPACING / 2

    assert crda(found, upright()) == pytest.approx(1.0)


def test_the_centre_is_judged_at_the_lower_edge() -> None:
    leaning = TrueLattice(np.linspace(-2 * SPACING, 0, HEIGHT), np.full(HEIGHT, SPACING))
    found = rows_of(leaning, -1, 0, 1, 2, 3)
    found[[3, 4]] += SPACING / 2

    assert crda(found, leaning) == pytest.approx(1.0)


def test_an_outer_row_cannot_be_the_middle_one() -> None:
    """Nearest the centre is the first row of all, so the three are it and the two on its right."""
    found = rows_of(upright(), 0, 1, 2)
    found[2] += SPACING / 2

    assert crda(found, upright()) == pytest.approx(2 / 3)


def test_only_the_image_rows_asked_for_count() -> None:
    found = rows_of(upright(), -1, 0, 1)
    found[:, :LOWER_HALF_PX] += SPACING / 2

    assert crda(found, upright(), LOWER_HALF_PX) == pytest.approx(1.0)
    assert crda(found, upright()) == pytest.approx(0.5)


def test_image_rows_without_ground_truth_do_not_count() -> None:
    truth = upright()
    unknown = np.arange(HEIGHT) < 60
    partial = TrueLattice(
        np.where(unknown, np.nan, truth.offset_px), np.where(unknown, np.nan, truth.spacing_px)
    )
    found = rows_of(truth, -1, 0, 1)
    found[:, :60] += SPACING / 2

    assert crda(found, partial) == pytest.approx(1.0)


def test_a_true_row_outside_the_picture_cannot_be_met() -> None:
    wide = TrueLattice(np.zeros(HEIGHT), np.full(HEIGHT, 170.0))

    assert crda(rows_of(wide, -1, 0, 1), wide) == pytest.approx(1 / 3)


def test_ground_truth_without_a_row_in_the_picture_cannot_be_met() -> None:
    beside = TrueLattice(np.full(HEIGHT, 500.0), np.full(HEIGHT, 1000.0))

    assert crda(rows_of(upright(), -1, 0, 1), beside) == 0
    assert true_rows(rows_of(upright(), 0), beside).tolist() == [UNMATCHED]


def test_a_curve_is_taken_at_every_image_row_and_ends_where_it_ends() -> None:
    bent = np.array([[[100.0, 0.0], [120.0, 120.0], [110.0, 239.0]]])
    short = np.array([[[100.0, 60.0], [120.0, 120.0], [110.0, 239.0]]])

    assert positions(bent)[0, [0, 60, 120, 239]].tolist() == [100, 110, 120, 110]
    assert np.isnan(positions(short)[0, :60]).all() and positions(short)[0, 60] == 100
    assert positions(np.empty((0, 5, 2))).shape == (0, HEIGHT)


def test_a_curve_that_ends_early_scores_nothing_where_it_is_not() -> None:
    found = rows_of(upright(), -1, 0, 1)
    found[:, :60] = np.nan

    assert crda(found, upright()) == pytest.approx(0.75)


@pytest.mark.parametrize(("off", "right"), [(0.24, True), (0.26, False), (-0.24, True)])
def test_a_row_is_right_within_a_quarter_of_the_spacing_over_the_lower_half(off: float, right: bool) -> None:
    found = rows_of(upright(), 1) + off * SPACING
    found[:, :LOWER_HALF_PX] += SPACING / 2

    assert (true_rows(found, upright()) != UNMATCHED).tolist() == [right]


def test_a_true_row_makes_one_found_row_right() -> None:
    found = rows_of(upright(), 1, 1, 2)

    assert np.sum(true_rows(found, upright()) != UNMATCHED) == 2


def test_a_row_beside_the_picture_is_not_right() -> None:
    assert true_rows(rows_of(upright(), -6), upright()).tolist() == [UNMATCHED]


def test_the_last_line_of_ground_truth_is_the_lowest_image_row(tmp_path: Path) -> None:
    path = tmp_path / "a.crp"
    path.write_text("-1.0\t30.0\n2.0\t31.0", encoding="utf-8")

    truth = read_truth(path)

    assert truth.offset_px[-2:].tolist() == [-1, 2] and truth.spacing_px[-2:].tolist() == [30, 31]
    assert np.isnan(truth.offset_px[:-2]).all()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("1.0\tx", "is no table; allowed is 2 numbers a line"),
        ("1.0\n2.0", "is no table"),
        ("1.0\tnan", "finite"),
        ("", "has 0 lines; allowed is 1 to 240"),
        ("1.0\t2.0\n" * 241, "has 241 lines"),
        ("1.0\t0.0", "d: 0: allowed is 1 px or more"),
    ],
)
def test_wrong_ground_truth_is_said_in_one_line(content: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "a.crp"
    path.write_text(content, encoding="utf-8")

    with pytest.raises(SettingsError, match=said) as error:
        read_truth(path)

    assert str(error.value).startswith(f"{path}: ")


def test_a_set_without_ground_truth_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match="holds no ground truth"):
        pictures_in(tmp_path)


def test_ours_stands_beside_the_authors_on_the_same_pictures(tmp_path: Path, photos: SimpleNamespace) -> None:
    folder = photos.crbd(tmp_path, count=2)
    shifted = [(CENTRE + k * SPACING + 2, CENTRE + k * SPACING + 2) for k in (-1, 0, 1)]

    figures, judged = crbd(folder, photos.finder(shifted), lambda part, done, steps: None, quick=False)

    assert [(figure.value, figure.best_known) for figure in figures[:2]] == [(pytest.approx(0.75), 1.0)] * 2
    assert [(figure.value, figure.best_known) for figure in figures[2:]] == [(1.0, 0.821), (1.0, 0.746)]
    assert [figure.met for figure in figures] == [False, False, None, None]
    assert judged.right.tolist() == [True] * 6


def test_without_the_authors_files_what_they_published_stands_beside_ours(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = photos.crbd(tmp_path, authors=False)

    figures, _ = crbd(folder, photos.finder([]), lambda part, done, steps: None, quick=False)

    assert [(figure.value, figure.best_known) for figure in figures] == [(0, 0.821), (0, 0.746)]


def test_doubtful_rows_do_not_score(tmp_path: Path, photos: SimpleNamespace) -> None:
    doubtful = [(CENTRE + k * SPACING, CENTRE + k * SPACING, 0.4 if k else 0.9) for k in (-1, 0, 1)]

    figures, judged = crbd(
        photos.crbd(tmp_path), photos.finder(doubtful), lambda part, done, steps: None, quick=False
    )

    assert figures[0].value == 0
    assert judged.right.all() and len(judged) == 3


def test_a_quick_run_takes_a_part_of_the_pictures_and_says_how_many(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    told: list[tuple[int, int]] = []

    figures, _ = crbd(
        photos.crbd(tmp_path, count=5), photos.finder([]), lambda part, *at: told.append(at), quick=True
    )

    assert "2 images" in figures[0].case
    assert told == [(0, 2), (1, 2), (2, 2)]


def test_a_picture_of_another_size_is_refused(tmp_path: Path, photos: SimpleNamespace) -> None:
    folder = photos.crbd(tmp_path)
    photos.picture(folder / "images" / "crop_row_000.jpg", (640, 480))

    with pytest.raises(SettingsError, match="size: 640x480: allowed is 320x240"):
        crbd(folder, photos.finder([]), lambda part, done, steps: None, quick=False)
