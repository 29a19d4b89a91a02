"""Recognition: the same row looks the same a moment later, another row does not."""

from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.messages import Image
from fieldnav.perception.recognition import Descriptors, describe, distance

EVERY_MATCH = 0.0
SHIFT_PX = 12


@pytest.fixture(scope="module")
def textured(drawn: SimpleNamespace) -> Image:
    """Three rows whose plants and soil have leaves and clods, each different."""
    random = np.random.default_rng(3)
    image = drawn.picture(drawn.beet, drawn.camera, drawn.stand(drawn.beet, scatter_m=0.01))
    for _ in range(2500):
        x, y, long, thin, turn, light = random.integers([0, 0, 4, 2, 0, -60], [1280, 720, 20, 8, 180, 60])
        colour = np.clip(image[y, x].astype(int) + light, 0, 255).tolist()
        cv2.ellipse(image, (int(x), int(y)), (int(long), int(thin)), int(turn), 0, 360, colour, -1)
    return image


def moved(image: Image) -> Image:
    """The picture after the robot has moved a little sideways, with fresh sensor noise."""
    grain = np.random.default_rng(9).normal(0, 3, image.shape)
    return np.clip(np.roll(image, SHIFT_PX, axis=1) + grain, 0, 255).astype(np.uint8)


def described(drawn: SimpleNamespace, image: Image, row: int, shift_px: int = 0) -> Descriptors:
    line = drawn.rows(drawn.beet, drawn.camera)[row]
    line = type(line)(line.x_top_px + shift_px, line.x_bottom_px + shift_px)
    return describe(image, line, drawn.beet, drawn.camera)


@pytest.mark.parametrize("row", [0, 1, 2])
def test_a_row_is_nearer_to_itself_than_to_any_other(
    drawn: SimpleNamespace, textured: Image, row: int
) -> None:
    reference = described(drawn, textured, row)
    later = moved(textured)

    away = [distance(reference, described(drawn, later, other, SHIFT_PX), EVERY_MATCH) for other in range(3)]

    assert None not in away
    same, others = away[row], [value for other, value in enumerate(away) if other != row]
    assert same is not None
    assert same < 0.8 * min(value for value in others if value is not None)


def test_the_same_input_twice_gives_the_same_distance(drawn: SimpleNamespace, textured: Image) -> None:
    later = moved(textured)

    first, second = (
        distance(described(drawn, textured, 0), described(drawn, later, 1, SHIFT_PX), EVERY_MATCH)
        for _ in range(2)
    )

    assert first == second


def test_features_lie_in_the_rows_parallelogram_between_the_two_image_rows(
    drawn: SimpleNamespace, textured: Image
) -> None:
    row = drawn.rows(drawn.beet, drawn.camera)[0]

    found = describe(textured, row, drawn.beet, drawn.camera, 100, 400)

    x, y = found.position_px.T
    line = row.x_top_px + (row.x_bottom_px - row.x_top_px) * y / 719
    assert len(found) > 20
    assert y.min() >= 98 and y.max() <= 402
    assert np.abs(x - line).max() < 130


def test_matches_up_to_lambda_are_left_out(drawn: SimpleNamespace, textured: Image) -> None:
    reference, candidate = described(drawn, textured, 0), described(drawn, moved(textured), 0, SHIFT_PX)

    every, above = (distance(reference, candidate, ratio) for ratio in (EVERY_MATCH, 150.0))

    assert every is not None and above is not None
    assert above > max(every, 150.0)


def test_too_few_features_say_nothing(drawn: SimpleNamespace, textured: Image) -> None:
    bare = np.full((720, 1280, 3), drawn.soil, np.uint8)
    outside = described(drawn, textured, 0, shift_px=-2000)

    assert len(outside) == 0
    assert distance(described(drawn, textured, 0), described(drawn, bare, 0), EVERY_MATCH) is None
    assert distance(outside, described(drawn, textured, 0), EVERY_MATCH) is None
