"""`fieldnav detect --overlay`: what was found, drawn into the picture."""

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from fieldnav.cli.app import run

Objects = Callable[[], list[dict[str, Any]]]


def test_the_overlay_is_the_picture_with_a_graph_beneath(
    picture: Path, tmp_path: Path, plots: SimpleNamespace
) -> None:
    folder = tmp_path / "new" / "overlays"
    other = tmp_path / "in" / "field.jpg"
    cv2.imwrite(str(other), plots.field(plots.camera(320, 240)))

    assert run(["detect", str(picture), str(other), "--overlay", str(folder), "--json"]) == 0

    first, second = (cv2.imread(str(folder / name)) for name in ("field-rows.jpg", "field-2-rows.jpg"))
    assert first is not None and second is not None
    assert first.shape[1] == 1280 and first.shape[0] > 720
    assert second.shape[1] == 1280 and second.shape[0] > 960, "a small picture is shown four times as large"
    assert sorted(path.name for path in picture.parent.iterdir()) == ["field.jpg", "field.png"]


@pytest.mark.parametrize("options", [[], ["--robot", "bonnbot"]], ids=" ".join)
def test_the_overlay_differs_from_the_picture_where_rows_are(
    options: list[str], picture: Path, tmp_path: Path, plots: SimpleNamespace, objects: Objects
) -> None:
    assert run(["detect", str(picture), *options, "--overlay", str(tmp_path), "--json"]) == 0

    rows = objects()[0]["rows"]
    drawn = cv2.imread(str(tmp_path / "field-rows.jpg"))
    assert drawn is not None and isinstance(rows, list)
    changed = np.abs(drawn[:720].astype(int) - plots.field(plots.camera(1280, 720))).max(axis=2)
    middle = rows[len(rows) // 2]
    y = np.arange(40, 680)
    x = np.interp(y, [point[1] for point in middle["points"]], [point[0] for point in middle["points"]])
    assert changed[y, np.rint(x).astype(int)].min() > 60, "the row is one unbroken line"
    between = np.rint(x + 70).astype(int)
    assert np.median(changed[y, between]) < 40, "the ground beside it is still seen"


def test_the_overlay_marks_rows_at_the_same_place_in_the_picture_and_in_the_graph(
    picture: Path, tmp_path: Path, objects: Objects
) -> None:
    assert run(["detect", str(picture), "--robot", "bonnbot", "--overlay", str(tmp_path), "--json"]) == 0

    rows = objects()[0]["rows"]
    drawn = cv2.imread(str(tmp_path / "field-rows.jpg"))
    assert drawn is not None and isinstance(rows, list)
    for row in rows:
        x = round(row["points"][4][0])
        if 10 <= x < 1270:
            assert blue(drawn[359:361, x - 3 : x + 4]), "the square on the row"
            assert blue(drawn[-23:-16, x - 3 : x + 4]), "the square in the graph beneath it"


def blue(part: NDArray[Any]) -> bool:
    """Whether that is the colour of a row, paler for a less sure one; no leaf, soil or paper has it."""
    colour = part.reshape(-1, 3).mean(axis=0)
    return bool(colour[0] > 180 and colour[0] - colour[2] > 10)


@pytest.mark.parametrize("options", [[], ["--robot", "bonnbot"]], ids=" ".join)
def test_the_bare_field_has_an_overlay_too(
    options: list[str], tmp_path: Path, plots: SimpleNamespace
) -> None:
    bare = tmp_path / "bare.png"
    cv2.imwrite(str(bare), np.full((72, 128, 3), plots.soil_bgr, np.uint8))

    assert run(["detect", str(bare), *options, "--overlay", str(tmp_path / "overlays")]) == 0

    assert (tmp_path / "overlays" / "bare-rows.jpg").exists()


@pytest.mark.parametrize("size", [(64, 2000), (2000, 64)])
def test_pictures_of_odd_shapes_have_overlays(
    size: tuple[int, int], tmp_path: Path, plots: SimpleNamespace
) -> None:
    cv2.imwrite(str(tmp_path / "odd.png"), np.full((size[1], size[0], 3), plots.leaf_bgr, np.uint8))

    assert run(["detect", str(tmp_path / "odd.png"), "--overlay", str(tmp_path), "--json"]) == 0

    assert (tmp_path / "odd-rows.jpg").exists()
