"""Crops of photographs, named in words: which profile each has, and what is done for one without."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from fieldnav.evaluation.found_rows import FoundRows
from fieldnav.evaluation.near_nadir import near_nadir, profile_of
from fieldnav.messages import Image
from fieldnav.settings.crop import CropProfile

NO_BAR = lambda part, done, steps: None  # noqa: E731 - what a benchmark tells where nobody watches


@pytest.mark.parametrize(
    ("crop", "profile"),
    [
        ("maize", "maize"),
        ("maize (early)", "maize"),
        ("winter wheat", "winter-wheat"),
        ("Sugar  Beet (BBCH 14)", "sugar-beet"),
        ("soybean", "soybean"),
    ],
)
def test_a_crop_in_words_has_the_profile_of_that_name(crop: str, profile: str) -> None:
    found = profile_of(crop)

    assert found is not None and found.name == profile


@pytest.mark.parametrize("crop", ["rice", "(early)", "../maize", "maize.yaml"])
def test_a_crop_without_a_profile_has_none(crop: str) -> None:
    assert profile_of(crop) is None


def test_a_crop_without_a_profile_is_found_without_one_and_said_to_be(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    asked: list[str | None] = []

    def find(image: Image, crop: CropProfile | None) -> FoundRows:
        asked.append(crop.name if crop else None)
        found: FoundRows = photos.found(photos.rows)
        return found

    figures, _ = near_nadir(photos.near_nadir(tmp_path, crops=("rice", "maize")), find, NO_BAR)

    assert asked == [None, "maize", "maize"]
    assert [figure.case for figure in figures if figure.metric == "F1"] == [
        "near view, all",
        "near view, rice (no crop profile)",
        "near view, maize",
        "near view, all with a crop profile (moving variance)",
        "near view, maize (moving variance)",
    ]


def test_without_any_profile_nothing_is_said_of_the_moving_variance(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = photos.near_nadir(tmp_path, crops=("rice",))

    figures, _ = near_nadir(folder, photos.finder(photos.rows), NO_BAR)

    assert figures[0].value == 1
    assert not any("moving variance" in figure.case for figure in figures)
