"""Pictures in which rows were found wrongly: which answer is right, and to what it is known."""

from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Plan, Report
from fieldnav.evaluation.found_rows import Finder
from fieldnav.evaluation.row_faults import ALL, RIGHT_COUNTS, RIGHT_ROWS, RightCount, RightRows, row_faults
from fieldnav.messages import Side
from fieldnav.perception.counting.row_count import Passage, RowCount

NO_BAR = lambda part, done, steps: None  # noqa: E731 - what a benchmark tells where nobody watches
WIDTH, HEIGHT = 320, 240
IMAGE = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
SOIL_BGR, LEAF_BGR = (72, 96, 122), (50, 150, 70)
ROWS_PX, STEP_PX, FRAMES = (63, 153, 243, 333, 423), 6, 20
"""The third row passes the middle in frame 14, no other does."""


def measured(data: Path, find: Finder, quick: bool = False) -> Report:
    return row_faults(Plan(data, quick), NO_BAR, find)


def values(report: Report) -> dict[str, list[float]]:
    """The values of each case, by its name without what all have before it."""
    named: dict[str, list[float]] = {}
    for figure in report.figures:
        named.setdefault(figure.case.removeprefix("row faults: "), []).append(figure.value)
    return named


def upright(*places: float) -> list[tuple[float, float]]:
    """Rows at shares of the width."""
    return [(place * WIDTH, place * WIDTH) for place in places]


@pytest.mark.parametrize(("count", "right"), [(1, False), (2, True), (4, True), (5, False)])
def test_so_many_rows_are_right(count: int, right: bool, photos: SimpleNamespace) -> None:
    found = photos.found(upright(*np.linspace(0.1, 0.9, count)))

    assert RightRows(2, 4).is_given_by(found, IMAGE) is right


@pytest.mark.parametrize(
    ("lines", "right"),
    [
        ([], True),
        (upright(0.5), True),
        (upright(0.2), False),
        ([(0.5 * WIDTH, -0.1 * WIDTH)], False),  # at mid-height 0.2
        ([(0.2 * WIDTH, 0.6 * WIDTH)], True),  # at mid-height 0.4
        (upright(-0.2), True),
    ],
)
def test_no_row_may_run_where_there_is_no_crop(
    lines: list[tuple[float, float]], right: bool, photos: SimpleNamespace
) -> None:
    assert RightRows(0, 3, bare=(0.0, 0.25)).is_given_by(photos.found(lines), IMAGE) is right


@pytest.mark.parametrize(
    ("frames", "moved", "right"),
    [
        ((14,), Side.RIGHT, True),
        ((16,), Side.RIGHT, True),
        ((17,), Side.RIGHT, False),
        ((), Side.RIGHT, False),
        ((14, 20), Side.RIGHT, False),
        ((14,), Side.LEFT, False),
    ],
)
def test_one_row_is_to_be_counted_at_about_its_frame(
    frames: tuple[int, ...], moved: Side, right: bool
) -> None:
    passages = tuple(Passage(frame, row, moved) for row, frame in enumerate(frames))

    assert RightCount(14).is_given_by(RowCount(passages, Side.RIGHT)) is right


@pytest.mark.parametrize(
    ("right", "said"),
    [
        (RightRows(0, 0), "no row"),
        (RightRows(2, 4), "2 to 4 rows"),
        (RightRows(1, 1, bare=(0.6, 1.0)), "1 row, none from 0.6 to 1 of the width"),
        (RightCount(14), "1 row counted, at frame 14 +- 2, nothing given"),
        (RightCount(40, "maize", "r.yaml"), "1 row counted, at frame 40 +- 2, maize, r.yaml given"),
    ],
)
def test_a_right_answer_reads(right: RightRows | RightCount, said: str) -> None:
    assert str(right) == said


def test_a_set_that_is_absent_is_left_out_in_one_line(tmp_path: Path, photos: SimpleNamespace) -> None:
    report = measured(tmp_path, photos.finder([]))

    (left_out,) = report.left_out
    assert left_out.reason == f"there is no folder {tmp_path / 'row_faults'}" and report.figures == ()
    (left_out,) = row_faults(Plan(None, quick=False), NO_BAR, photos.finder([])).left_out
    assert "--data" in left_out.reason


def test_every_picture_has_a_figure_and_all_have_one(tmp_path: Path, photos: SimpleNamespace) -> None:
    for name in ("f01_verge.png", "f05b_verge.jpg", "f07_leafy.jpg", "f17_lawn.jpg"):
        photos.picture(tmp_path / "row_faults" / name)

    none = measured(tmp_path, photos.finder([]))
    three = measured(tmp_path, photos.finder(upright(0.2, 0.4, 0.5)))
    one = measured(tmp_path, photos.finder(upright(0.4)))

    assert [values(report)["all"] for report in (none, three, one)] == [[0.25]] * 3
    assert (
        values(none)["f05b_verge.jpg"] == values(three)["f07_leafy.jpg"] == values(one)["f17_lawn.jpg"] == [1]
    )
    assert [figure.goal for figure in none.figures] == [1.0] * 5
    assert none.figures[0].metric == "right (1) or wrong (0): 6 to 8 rows"
    assert none.figures[-1].case == ALL and none.left_out == ()


def test_the_longest_beginning_of_a_name_tells(tmp_path: Path, photos: SimpleNamespace) -> None:
    for name in ("f05_crdld131_verge.jpg", "f05b.jpg", "f01_whole.png", "f01b_cut.png"):
        photos.picture(tmp_path / "row_faults" / name)

    found = values(measured(tmp_path, photos.finder(upright(0.3, 0.5, 0.7, 0.9))))

    assert found["f05_crdld131_verge.jpg"] == found["f01b_cut.png"] == [1]
    assert found["f05b.jpg"] == found["f01_whole.png"] == [0]


def test_a_doubtful_row_is_none(tmp_path: Path, photos: SimpleNamespace) -> None:
    photos.picture(tmp_path / "row_faults" / "f19_sky.jpg")

    assert values(measured(tmp_path, photos.finder([(160, 160, 0.4)])))["all"] == [1]


def test_what_has_no_known_answer_is_left_out_and_what_is_no_picture_passed_over(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = tmp_path / "row_faults"
    for name in ("f19_sky.jpg", "f99_new.jpg", ".f12_hidden.jpg", "f98_frames/1.jpg"):
        photos.picture(folder / name)
    (folder / "README.md").write_text("faults", encoding="utf-8")
    (folder / "empty").mkdir()

    report = measured(tmp_path, photos.finder([]))

    assert [part.reason for part in report.left_out] == [
        "of f98_frames no right answer is known",
        "of f99_new.jpg no right answer is known",
    ]
    assert list(values(report)) == ["f19_sky.jpg", "all"]


def test_a_folder_without_any_known_case_is_left_out(tmp_path: Path, photos: SimpleNamespace) -> None:
    (tmp_path / "row_faults").mkdir()

    report = measured(tmp_path, photos.finder([]))

    assert report.figures == () and "holds no picture" in report.left_out[-1].reason


def test_a_quick_run_takes_every_tenth_case(tmp_path: Path, photos: SimpleNamespace) -> None:
    for number in range(11):
        photos.picture(tmp_path / "row_faults" / f"f12_{number:02}.jpg")

    report = measured(tmp_path, photos.finder([]), quick=True)

    assert list(values(report)) == ["f12_00.jpg", "f12_10.jpg", "all"]


def write_sequence(folder: Path, first_px: int = 0) -> None:
    """Drawn rows seen from straight above, the camera moving right."""
    rng = np.random.default_rng(5)
    strip = np.full((HEIGHT, 700, 3), SOIL_BGR, np.uint8)
    for row in ROWS_PX:
        for y in range(8, HEIGHT, 24):
            at = (row + int(rng.integers(-3, 4)), y + int(rng.integers(-6, 7)))
            cv2.circle(strip, at, int(rng.integers(6, 11)), LEAF_BGR, cv2.FILLED)
    folder.mkdir(parents=True)
    for number in range(FRAMES):
        place = first_px + STEP_PX * number
        cv2.imwrite(str(folder / f"{number}.png"), strip[:, place : place + WIDTH])


def write_profiles(folder: Path) -> None:
    """The files that are told to the counter of one sequence: shipped profiles under other names."""
    shipped = Path(__file__).parents[2] / "config"
    for name, profile in (("soy76.yaml", "crops/soybean.yaml"), ("vmaize.yaml", "robots/bonnbot.yaml")):
        (folder / name).write_text((shipped / profile).read_text(encoding="utf-8"), encoding="utf-8")


def test_a_sequence_is_counted_with_what_is_known_and_with_nothing(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = tmp_path / "row_faults"
    write_sequence(folder / "f10_rows")
    write_sequence(folder / "f10_rows_elsewhere", first_px=40)
    write_profiles(folder)

    found = values(measured(tmp_path, photos.finder([])))

    assert found["f10_rows"][0] == 1 and len(found["f10_rows"]) == 2
    assert found["f10_rows_elsewhere"][0] == 0, "there the row passes in another frame"


def test_profiles_lie_beside_the_sequence_and_a_wrong_one_is_named(
    tmp_path: Path, photos: SimpleNamespace
) -> None:
    folder = tmp_path / "row_faults"
    photos.picture(folder / "f10_rows" / "0.jpg")
    write_profiles(folder)
    (folder / "vmaize.yaml").write_text("name: 5", encoding="utf-8")
    with pytest.raises(SettingsError, match=r"row_faults/vmaize\.yaml"):
        measured(tmp_path, photos.finder([]))

    (folder / "soy76.yaml").unlink()
    with pytest.raises(SettingsError, match=r"row_faults/soy76\.yaml"):
        measured(tmp_path, photos.finder([]))


def test_frames_of_different_sizes_are_refused(tmp_path: Path, photos: SimpleNamespace) -> None:
    folder = tmp_path / "row_faults" / "f11_rows"
    photos.picture(folder / "0.jpg")
    photos.picture(folder / "1.jpg", (64, 48))

    with pytest.raises(SettingsError, match=r"1\.jpg: size: 64x48: allowed is 320x240"):
        measured(tmp_path, photos.finder([]))


def test_the_table_of_right_answers_makes_sense() -> None:
    assert all(0 <= right.fewest <= right.most for right in RIGHT_ROWS.values())
    stretches = [right.bare for right in RIGHT_ROWS.values() if right.bare]
    assert all(0 <= left < right <= 1 for left, right in stretches)
    assert not any(name.startswith(tuple(RIGHT_COUNTS)) for name in RIGHT_ROWS)
