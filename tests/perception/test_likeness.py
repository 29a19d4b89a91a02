"""Likeness: the features of one row move over the ground together, those of another row do not."""

from dataclasses import replace
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.messages import Image, RowLine
from fieldnav.perception.likeness import Likeness, likeness
from fieldnav.perception.recognition import Descriptors, describe

FEATURES = 60
SHIFT_PX = 40


def features(seed: int = 1) -> Descriptors:
    """Features that are all unlike each other, spread over half a metre of a row 0.2 m to the left."""
    rng = np.random.default_rng(seed)
    beside_m, ahead_m = rng.uniform(-0.15, 0.15, FEATURES), rng.uniform(1.2, 1.7, FEATURES)
    return Descriptors(
        rng.uniform(0, 100, (FEATURES, 128)).astype(np.float32),
        rng.uniform(0, 700, (FEATURES, 2)),
        np.stack([ahead_m, beside_m + 0.2], axis=-1),
        beside_m,
        rng.uniform(0, 360, FEATURES),
        rng.uniform(3, 12, FEATURES),
    )


def told(reference: Descriptors, candidate: Descriptors, drawn: SimpleNamespace) -> Likeness:
    said = likeness(reference, candidate, drawn.beet)
    assert said is not None
    return said


def sideways(row: Descriptors, left_m: float, line_off_m: float = 0.0) -> Descriptors:
    """The same row after the view has moved, its line followed but for an error."""
    return replace(row, ground_m=row.ground_m + np.array([0.0, left_m]), beside_m=row.beside_m + line_off_m)


@pytest.mark.parametrize("left_m", [-0.4, -0.03, 0.0, 0.15])
def test_a_row_that_moves_as_a_whole_is_the_same_and_its_shift_is_told(
    left_m: float, drawn: SimpleNamespace
) -> None:
    row = features()

    said = told(row, sideways(row, left_m, line_off_m=0.03), drawn)

    assert (said.together, said.compared, said.is_new) == (FEATURES, FEATURES, False)
    assert said.shift_m == pytest.approx((0.0, left_m))
    assert said.sure > 0.99


def test_the_way_back_is_the_way_there_with_the_other_sign(drawn: SimpleNamespace) -> None:
    row, later = features(), sideways(features(), 0.1)

    there, back = told(row, later, drawn), told(later, row, drawn)

    assert there.share == back.share
    assert there.shift_m is not None and back.shift_m is not None
    assert there.shift_m == pytest.approx([-part for part in back.shift_m])


def test_features_that_look_alike_but_lie_anywhere_make_a_new_row(drawn: SimpleNamespace) -> None:
    row = features()
    elsewhere = features(seed=2)
    alike = replace(row, ground_m=elsewhere.ground_m, beside_m=elsewhere.beside_m)

    said = told(row, alike, drawn)

    assert said.distance == 0, "the paper's measure cannot tell"
    assert said.share < 0.35 * told(row, row, drawn).share


@pytest.mark.parametrize(
    ("turned_deg", "grown", "known"),
    [(15, 1.0, True), (359, 1.0, True), (40, 1.0, False), (180, 1.0, False), (0, 1.3, True), (0, 1.8, False)],
)
def test_a_feature_that_turned_or_grew_more_than_a_step_makes_it_is_another(
    turned_deg: float, grown: float, known: bool, drawn: SimpleNamespace
) -> None:
    row = features()
    later = replace(row, angle_deg=(row.angle_deg + turned_deg) % 360, size_px=row.size_px * grown)

    assert told(row, later, drawn).together == (FEATURES if known else 0)


@pytest.mark.parametrize(("off_m", "known"), [(0.07, True), (-0.07, True), (0.1, False), (-0.35, False)])
def test_a_row_is_not_known_again_by_what_grows_beside_it(
    off_m: float, known: bool, drawn: SimpleNamespace
) -> None:
    row = features()

    said = told(row, sideways(row, 0.0, line_off_m=off_m), drawn)

    assert said.is_new is not known
    assert (said.shift_m is None) is not known


def test_rows_sown_close_together_must_be_followed_more_exactly(drawn: SimpleNamespace) -> None:
    narrow = drawn.beet.model_copy(update={"rows": drawn.beet.rows.model_copy(update={"spacing_m": 0.125})})
    row = features()

    said = likeness(row, sideways(row, 0.0, line_off_m=0.07), narrow)

    assert said is not None and said.is_new


def test_the_more_features_say_so_the_surer_it_is() -> None:
    few, many = (Likeness(count // 10, count, None, 300.0, 0.05) for count in (10, 200))
    on_the_border = Likeness(5, 100, None, 300.0, 0.05)

    assert on_the_border.sure == 0.5
    assert on_the_border.sure < few.sure < many.sure <= 1


def test_too_few_features_tell_nothing(drawn: SimpleNamespace) -> None:
    row = features()
    few = Descriptors(*(getattr(row, name)[:7] for name in Descriptors.__slots__))

    assert likeness(row, few, drawn.beet) is None
    assert likeness(few, row, drawn.beet) is None


def test_the_paper_s_measure_is_given_beside(drawn: SimpleNamespace) -> None:
    row = features()
    other = replace(row, vectors=row.vectors + np.float32(5))

    assert told(row, other, drawn).distance == pytest.approx(5 * 128**0.5, rel=1e-3)


@pytest.fixture(scope="module")
def ground(drawn: SimpleNamespace) -> Image:
    """Three rows whose plants and soil have leaves and clods, each different."""
    random = np.random.default_rng(3)
    image = drawn.picture(drawn.beet, drawn.camera, drawn.stand(drawn.beet, scatter_m=0.01))
    for _ in range(2500):
        x, y, long, thin, turn, light = random.integers([0, 0, 4, 2, 0, -60], [1280, 720, 20, 8, 180, 60])
        colour = np.clip(image[y, x].astype(int) + light, 0, 255).tolist()
        cv2.ellipse(image, (int(x), int(y)), (int(long), int(thin)), int(turn), 0, 360, colour, -1)
    return image


@pytest.mark.parametrize("known", [0, 1, 2])
def test_in_pictures_one_row_is_known_again_and_the_others_are_new(
    known: int, drawn: SimpleNamespace, ground: Image
) -> None:
    later = np.roll(ground, SHIFT_PX, axis=1)
    rows = drawn.rows(drawn.beet, drawn.camera)
    moved = [RowLine(row.x_top_px + SHIFT_PX, row.x_bottom_px + SHIFT_PX) for row in rows]
    half = {"top_px": 0.0, "bottom_px": drawn.camera.centre_y_px}
    reference = describe(ground, rows[known], drawn.beet, drawn.camera, **half)

    said = [
        likeness(reference, describe(later, row, drawn.beet, drawn.camera, **half), drawn.beet)
        for row in moved
    ]

    assert [each.is_new for each in said if each] == [row != known for row in range(3)]
    same = said[known]
    assert same is not None and same.shift_m is not None
    step_m = -SHIFT_PX / float(drawn.camera.pixels_per_metre(drawn.camera.height_px / 4))
    assert same.shift_m == pytest.approx((0.0, step_m), abs=0.01)
