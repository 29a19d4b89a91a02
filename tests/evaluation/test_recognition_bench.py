"""The benchmark of telling rows apart: its pairs, its scores, its figures and its picture."""

from collections import Counter
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.errors import OutputError
from fieldnav.evaluation.benchmark import Figure, Plan
from fieldnav.evaluation.recognition import CROPS, crop_figures, judge, recognition_figures, row_pairs
from fieldnav.evaluation.recognition_pairs import Look, RowPair, balanced_pairs
from fieldnav.evaluation.recognition_plot import draw_recognition
from fieldnav.evaluation.recognition_scene import RowEndScene
from fieldnav.evaluation.recognition_scores import JudgedPairs, curve, scores
from fieldnav.perception.canopy import half_width_px, line_px
from fieldnav.perception.recognition import NOTHING
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised

F1 = "new row or the same, F1 (%)"


def flags(text: str) -> np.ndarray:
    return np.array([letter == "n" for letter in text])


def judged(is_new: str, share: list[float], distance: list[float], apart_m: float = 0.1) -> JudgedPairs:
    return JudgedPairs(
        flags(is_new), np.array(share), np.array(distance), np.full(len(is_new), apart_m, float)
    )


def test_precision_counts_those_called_new_and_recall_those_that_are() -> None:
    told = scores(flags("nnn---"), flags("nn-n--"))

    assert (told.precision, told.recall) == pytest.approx((2 / 3, 2 / 3))
    assert scores(flags("n----"), flags("nnnn-")).f1 == pytest.approx(2 * 1 * 0.25 / 1.25)


def test_the_curve_goes_from_the_surest_pair_to_every_pair_called_new() -> None:
    found = curve(np.array([0.9, 0.1, 0.8, 0.4]), flags("n-nn"))

    assert found.recall.tolist() == pytest.approx([1 / 3, 2 / 3, 1, 1])
    assert found.precision.tolist() == pytest.approx([1, 1, 1, 3 / 4])


def test_pairs_of_one_value_are_called_alike() -> None:
    found = curve(np.array([0.5, 0.5, 0.5, 0.1]), flags("n-n-"))

    assert found.precision.tolist() == pytest.approx([2 / 3, 1 / 2])


def test_every_threshold_of_the_curve_scores_what_it_says() -> None:
    random = np.random.default_rng(4)
    novelty, is_new = random.integers(0, 9, 60).astype(float), random.random(60) < 0.5

    found = curve(novelty, is_new)

    for threshold, precision, recall in zip(
        np.unique(novelty)[::-1], found.precision, found.recall, strict=True
    ):
        told = scores(novelty >= threshold, is_new)
        assert (told.precision, told.recall) == pytest.approx((precision, recall))


def look(row: int, right_m: float) -> Look:
    """One of four rows a step of 0.3 m apart, seen by a robot so far to the right."""
    return Look((0, row), right_m, right_m - 0.3 * row, NOTHING)


def test_pairs_are_balanced_and_in_the_order_in_which_they_were_seen() -> None:
    places_m = np.arange(0, 0.9, 0.03)
    pictures = [[look(row, place) for row in range(4)] for place in places_m]

    pairs = balanced_pairs(pictures, np.random.default_rng(1))

    kinds = Counter("new" if pair.is_new else "near" if pair.apart_m <= 0.15 else "far" for pair in pairs)
    assert kinds == {"new": 60, "near": 30, "far": 30}
    for pair in pairs:
        assert pair.candidate.right_m > pair.reference.right_m
        if pair.is_new:
            assert abs(pair.reference.left_m - pair.candidate.left_m) <= 0.06
        else:
            assert 0.01 < pair.apart_m <= 0.40


def test_with_too_few_features_a_pair_is_called_new_by_either_measure() -> None:
    pairs = judge([RowPair(look(1, 0.0), look(1, 0.1))], load_crop("beans"))

    assert (pairs.share[0], pairs.distance[0]) == (0, np.inf)


def test_the_figures_of_a_crop_are_taken_at_the_thresholds_of_its_profile() -> None:
    beet = load_crop("sugar-beet")
    share, far = beet.recognition.new_row_share, beet.recognition.new_row_distance
    told = judged("nn--", [share - 0.01, share + 0.01, 0.5, 0.5], [far - 1, far + 1, far + 1, far - 1])

    figures = {figure.metric: figure for figure in crop_figures(beet, [told])}

    assert figures["precision (%)"].value == 100 and figures["recall (%)"].value == 50
    assert figures[F1].value == pytest.approx(200 / 3)
    assert (figures[F1].goal, figures[F1].best_known, figures[F1].met) == (95, 62.1, False)
    assert figures["F1 by the paper's measure (%)"].value == 50
    assert figures["same row known again within 15 cm (%)"].value == 100


def test_a_best_known_value_is_named_for_the_one_crop_that_has_it() -> None:
    (of_beans,) = [
        figure
        for figure in crop_figures(load_crop("beans"), [judged("n-", [0.0, 1.0], [400.0, 100.0])])
        if figure.metric == F1
    ]

    assert (of_beans.best_known, of_beans.source, of_beans.met) == (None, "", True)


def test_marked_rows_lie_on_plants_behind_the_row_ends() -> None:
    crop = load_crop("potato")
    field = revised(load_field("potato"), {"lanes": 2, "length_m": 4.0, "seed": 5})
    scene = RowEndScene(field, crop, load_robot("bonnbot"))

    seen = next(scene.pictures(np.array([0.1, 0.2])))

    green = seen.image.astype(int) @ [-1, 2, -1]
    assert sorted(seen.lines) == [(0, 0), (0, 1)]
    y = np.arange(60, 300)
    for line in seen.lines.values():
        x = line_px(line, y.astype(float), scene.camera)
        reach = half_width_px(y.astype(float), crop, scene.camera) / 2
        on_row = np.abs(np.arange(seen.image.shape[1]) - x[:, None]) <= reach[:, None]
        assert green[60:300][on_row].mean() > green[60:300].mean() + 10
    bare_m, first_m = scene.camera.view_m[0], scene.plan.s_first_m.mean()
    assert bare_m > 0 and 0.35 <= first_m - scene.along_m <= 0.5


def test_the_way_goes_right_for_one_seed_and_left_for_the_next() -> None:
    ways = {}
    for seed in (2, 3):
        pairs = row_pairs("coriander", seed, pictures=12)
        ways[seed] = {np.sign(pair.candidate.right_m - pair.reference.right_m) for pair in pairs}

    assert ways == {2: {1.0}, 3: {-1.0}}


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[Figure], Path, list[int]]:
    """A quick run: its figures, the folder it drew into, and what it told of its progress."""
    folder, done = tmp_path_factory.mktemp("plots"), []
    plan = Plan(None, quick=True, plots=folder)
    figures = recognition_figures(plan, lambda part, step, steps: done.append(step))
    return figures, folder, done


def test_every_crop_is_told_apart_at_one_threshold(quick: tuple[list[Figure], Path, list[int]]) -> None:
    of_f1 = [figure for figure in quick[0] if figure.metric == F1]

    assert [figure.case for figure in of_f1] == [f"rows told apart, {crop}" for crop in CROPS]
    assert all(figure.met for figure in of_f1), of_f1
    assert len({load_crop(crop).recognition.new_row_share for crop in CROPS}) == 1


def test_the_curves_are_drawn_and_progress_is_told(quick: tuple[list[Figure], Path, list[int]]) -> None:
    picture = cv2.imread(str(quick[1] / "precision_recall.png"))

    assert picture is not None and picture.std() > 5
    assert quick[2] == list(range(len(CROPS) + 1))


def test_a_picture_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    beet = load_crop("sugar-beet")
    pairs = {"sugar-beet": judged("n-", [0.0, 1.0], [400.0, 100.0])}

    with pytest.raises(OutputError, match=r"precision_recall\.png: cannot be written") as refused:
        draw_recognition(tmp_path / "absent", pairs, {"sugar-beet": beet.recognition})

    assert "\n" not in str(refused.value)
