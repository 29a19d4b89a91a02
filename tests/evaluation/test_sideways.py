"""The benchmark of rows passing sideways: what is true, how a count is judged, what is left out."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Figure, Plan
from fieldnav.evaluation.showing import Showing, order_of
from fieldnav.evaluation.sidestep_scene import SidestepScene
from fieldnav.evaluation.sideways import judge, sideways
from fieldnav.evaluation.sideways_truth import sequences_in, true_count
from fieldnav.messages import Side
from fieldnav.perception.counting.row_count import Passage, RowCount
from fieldnav.perception.counting.row_counter import RowCounter
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised

WIDTH, HEIGHT, STEP_PX = 320, 240, 10
ROWS_PX = (65, 155, 245, 335, 425)
SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)


def write_sequence(folder: Path, mode: str = "lateral", count: int = 24) -> None:
    """Drawn rows seen from straight above, the camera moving right, and where they truly run."""
    rng = np.random.default_rng(5)
    strip = np.full((HEIGHT, 700, 3), SOIL_BGR, np.uint8)
    for row in ROWS_PX:
        for y in range(8, HEIGHT, 24):
            at = (row + int(rng.integers(-3, 4)), y + int(rng.integers(-6, 7)))
            cv2.circle(strip, at, int(rng.integers(6, 11)), LEAF_BGR, cv2.FILLED)
    folder.mkdir(parents=True)
    frames = []
    for number in range(count):
        place = STEP_PX * number
        cv2.imwrite(str(folder / f"{number}.png"), strip[:, place : place + WIDTH])
        rows = [
            {"id": row, "x_top": x - place, "x_bottom": x - place, "flag": "f"}
            for row, x in enumerate(ROWS_PX)
            if 0 <= x - place < WIDTH
        ]
        frames.append({"file": f"{number}.png", "rows": rows})
    document = {"size": [WIDTH, HEIGHT], "mode": mode, "frames": frames}
    (folder / "gt.json").write_text(json.dumps(document), encoding="utf-8")


def test_only_sequences_taken_sideways_are_read(tmp_path: Path) -> None:
    write_sequence(tmp_path / "b_lateral")
    write_sequence(tmp_path / "a_forward", mode="forward")

    (sequence,) = sequences_in(tmp_path)

    assert sequence.name == "b_lateral" and len(sequence.paths) == 24
    assert sequence.beside[1, 0] == 155 - (WIDTH - 1) / 2
    assert np.isnan(sequence.beside[4, 0]), "the last row is not in the first picture"


def test_the_true_count_follows_the_order_in_which_frames_are_shown(tmp_path: Path) -> None:
    write_sequence(tmp_path / "lateral")
    (sequence,) = sequences_in(tmp_path)

    there = true_count(sequence.beside, range(24), Side.RIGHT)
    back = true_count(sequence.beside, range(24)[::-1], Side.RIGHT)
    and_back = true_count(sequence.beside, [*range(24), *range(24)[::-1]], Side.RIGHT)

    assert (there.rows_crossed, there.frames) == (2, (9, 18))
    assert (back.rows_crossed, back.frames) == (-2, (6, 15))
    assert and_back.rows_crossed == 0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "is no JSON"),
        ('{"size": [1, 2], "mode": "lateral", "frames": []}', "frames"),
        ('{"size": [1, 2], "mode": "upwards", "frames": [{"file": "a", "rows": []}]}', "mode"),
    ],
)
def test_a_truth_that_cannot_be_read_is_refused_in_one_line(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "one" / "gt.json"
    path.parent.mkdir()
    path.write_text(text, encoding="utf-8")

    with pytest.raises(SettingsError, match=said) as refused:
        sequences_in(tmp_path)

    assert str(refused.value).startswith(f"{path}: ") and "\n" not in str(refused.value)


def test_a_picture_of_another_size_than_the_truth_is_of_is_refused(tmp_path: Path) -> None:
    write_sequence(tmp_path / "lateral", count=2)
    cv2.imwrite(str(tmp_path / "lateral" / "1.png"), np.zeros((48, 64, 3), np.uint8))
    (sequence,) = sequences_in(tmp_path)

    with pytest.raises(SettingsError, match=r"1\.png: size: 64x48: allowed is 320x240"):
        sequence.images()


def test_photographs_without_a_sequence_taken_sideways_are_left_out_and_the_reason_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fieldnav.evaluation.sideways.FIELDS", ())  # what is rendered is of other tests
    folder = tmp_path / "near_nadir_jw" / "seq"
    write_sequence(folder / "any", mode="forward", count=2)

    report = sideways(Plan(tmp_path, quick=True), lambda part, done, steps: None)

    assert [part.reason for part in report.left_out] == [f"{folder} holds no sequence taken sideways"]


def counted(*frames: int) -> RowCount:
    passages = tuple(Passage(frame, row, Side.RIGHT) for row, frame in enumerate(frames))
    return RowCount(passages, Side.RIGHT)


def test_a_count_is_judged_by_its_sum_and_by_its_frames() -> None:
    late = judge(counted(12, 33), counted(10, 30))
    missed = judge(counted(30), counted(10, 30))

    assert (late.error, late.in_time, late.true) == (0, 1, 2)
    assert (missed.error, missed.in_time, missed.true) == (-1, 1, 2)


def test_every_showing_ends_where_it_should() -> None:
    ends = {showing: (order_of(showing, 30)[0], order_of(showing, 30)[-1]) for showing in Showing}

    assert ends.pop(Showing.BACKWARDS) == (29, 0)
    assert ends.pop(Showing.DROPPED) == (0, 27)
    assert set(ends.values()) == {(0, 29)}


def test_a_sequence_is_measured_in_every_way_and_the_rest_rendered(tmp_path: Path) -> None:
    write_sequence(tmp_path / "near_nadir_jw" / "seq" / "drawn_lateral")
    write_sequence(tmp_path / "near_nadir_jw" / "seq" / "short", count=3)

    report = sideways(Plan(tmp_path, quick=True), lambda part, done, steps: None)

    drawn = [figure for figure in report.figures if figure.case == "sideways, drawn_lateral"]
    assert [figure.metric for figure in drawn] == [
        *(f"rows counted wrongly, {showing.value}" for showing in Showing),
        "crossings within 2 frames (%)",
    ]
    assert all(figure.met for figure in drawn), drawn
    *counts, in_time = [figure.met for figure in report.figures if figure.case == "sideways, short"]
    assert all(counts) and in_time is None, "where no row is crossed there is no time to cross it in"
    assert any(figure.case.startswith("sidestep, ") for figure in report.figures)
    assert report.left_out == ()


def test_without_photographs_the_rendered_steps_are_measured_and_the_rest_is_said() -> None:
    report = sideways(Plan(None, quick=True), lambda part, done, steps: None)

    (left_out,) = report.left_out
    assert left_out.part == "rows passing sideways" and "--data" in left_out.reason
    assert {figure.case for figure in report.figures} == {"sidestep, demo", "sidestep, demo, unknown"}
    assert all(figure.met for figure in report.figures if is_count(figure)), report.figures


def is_count(figure: Figure) -> bool:
    return figure.metric.startswith("rows counted wrongly")


def test_rows_of_a_rendered_step_lie_where_the_picture_shows_plants() -> None:
    field = revised(load_field("demo"), {"lanes": 1})
    scene = SidestepScene(field, load_crop(field.crop), load_robot("bonnbot"))

    step = next(scene.pictures(np.array([0.1, 0.1]), 6.0))

    middle_row = step.image[330:390].astype(int)
    green = (2 * middle_row[..., 1] - middle_row[..., 0] - middle_row[..., 2]).mean(axis=0)
    centre = (step.image.shape[1] - 1) / 2
    for beside in step.beside_px:
        at = round(centre + beside)
        assert green[max(0, at - 40) : at + 40].mean() > green.mean() + 5
    assert list(step.beside_px) == sorted(step.beside_px)


def test_a_step_over_a_rendered_lane_is_counted_whatever_is_known() -> None:
    field = revised(load_field("potato"), {"lanes": 1})
    crop, robot = load_crop(field.crop), load_robot("bonnbot")
    steps = list(SidestepScene(field, crop, robot).pictures(np.arange(-0.6, 0.65, 0.04), 6.0))

    for known in ((None, None), (crop, robot.cameras.front.pinhole())):
        counter = RowCounter(*known)
        for step in steps:
            counter.add(step.image)
        assert counter.result(Side.RIGHT).rows_crossed == crop.rows.per_lane
