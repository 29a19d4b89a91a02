"""`fieldnav detect` in rough hands: pictures given twice over, cut short, without colour, nobody reading."""

import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from fieldnav.cli.app import run

DETECT = [sys.executable, "-m", "fieldnav", "detect"]
MANY = 1000
"""Times a picture is named, far more than are looked at until the first line has been read."""


def test_an_overlay_never_lies_over_a_picture_that_was_given(picture: Path) -> None:
    named_so = picture.with_name("field-rows.jpg")
    shutil.copyfile(picture, named_so)
    before = named_so.read_bytes()

    assert run(["detect", str(picture), str(named_so), "--overlay", str(picture.parent)]) == 0

    assert named_so.read_bytes() == before
    made = {path.name for path in picture.parent.iterdir()} - {picture.name, named_so.name}
    assert made == {"field-2-rows.jpg", "field-rows-rows.jpg"}


def test_an_overlay_does_not_follow_a_link_to_a_picture_that_was_given(picture: Path, tmp_path: Path) -> None:
    (tmp_path / "overlays").mkdir()
    (tmp_path / "overlays" / "field-rows.jpg").symlink_to(picture)
    before = picture.read_bytes()

    assert run(["detect", str(picture), "--overlay", str(tmp_path / "overlays")]) == 0

    assert picture.read_bytes() == before
    assert (tmp_path / "overlays" / "field-rows.jpg").is_symlink()


def test_a_file_in_place_of_the_overlay_folder_is_refused_by_the_options_name(
    picture: Path, error: Callable[[], str]
) -> None:
    assert run(["detect", str(picture), "--overlay", str(picture)]) == 2

    assert error().startswith(f"error: --overlay {picture}: cannot be written here: ")


def test_an_empty_name_is_shown_as_one(error: Callable[[], str]) -> None:
    assert run(["detect", ""]) == 2

    assert error() == "error: '': is no name that a file can have"


def test_a_picture_without_colour_is_warned_of_and_still_answered(
    picture: Path, plots: SimpleNamespace, capsys: pytest.CaptureFixture[str]
) -> None:
    grey = picture.with_name("grey.png")
    cv2.imwrite(str(grey), plots.field(plots.camera(640, 480)).mean(axis=-1))

    assert run(["detect", str(grey), str(picture)]) == 0

    said = capsys.readouterr()
    assert f"{grey}: no row" in said.out and f"{picture}: 3 rows" in said.out
    assert said.err == f"warning: {grey}: has no colour, by which plants are told from soil\n"


def test_a_person_is_told_which_rows_a_robot_without_a_crop_looks_for(
    picture: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["detect", str(picture), "--robot", "bonnbot"]) == 0

    assert "\nlooked for rows of sugar-beet, 0.35 m apart\n" in capsys.readouterr().out


@pytest.mark.parametrize("size", [(64, 48), (65, 49), (320, 48), (64, 1000)])
def test_the_smallest_pictures_and_the_narrowest_have_an_answer(
    size: tuple[int, int], tmp_path: Path, objects: Callable[[], list[dict[str, object]]]
) -> None:
    grain = np.random.default_rng(1).integers(0, 256, (size[1], size[0], 3))
    cv2.imwrite(str(tmp_path / "small.png"), grain.astype(np.uint8))

    assert run(["detect", str(tmp_path / "small.png"), "--json"]) == 0

    (found,) = objects()
    assert (found["width"], found["height"]) == size


def test_ctrl_c_half_way_leaves_whole_overlays_and_one_line(picture: Path, tmp_path: Path) -> None:
    overlays = tmp_path / "overlays"
    called = [*DETECT, *[str(picture)] * MANY, "--overlay", str(overlays), "--json"]

    with subprocess.Popen(called, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        running.stdout.readline()
        running.send_signal(signal.SIGINT)
        _, said = running.communicate()

    assert (running.returncode, said) == (130, "error: interrupted\n")
    assert all(cv2.imread(str(path)) is not None for path in overlays.iterdir())
    assert {path.name for path in overlays.iterdir()} <= {"field-rows.jpg"}


def test_a_reader_that_has_seen_enough_hears_nothing_more(picture: Path) -> None:
    called = [*DETECT, *[str(picture)] * MANY, "--json"]

    with subprocess.Popen(called, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None and running.stderr is not None
        running.stdout.readline()
        running.stdout.close()
        said = running.stderr.read()

    assert said == ""


def test_a_damaged_picture_is_refused_in_one_line_of_our_own(
    picture: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    jpeg = tmp_path / "hole.jpg"
    content = cv2.imencode(".jpg", cv2.imread(str(picture)))[1].tobytes()
    middle = len(content) // 2
    jpeg.write_bytes(content[:middle] + bytes(2000) + content[middle + 2000 :])

    assert run(["detect", str(picture), str(jpeg)]) == 2

    said = capfd.readouterr()
    assert said.out == "" and len(said.err.splitlines()) == 1
    assert said.err.startswith(f"error: {jpeg}: is no whole picture: its data is damaged; allowed is JPEG")


def test_a_cut_picture_is_refused_without_a_word_of_libpng(
    picture: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    picture.write_bytes(picture.read_bytes()[: picture.stat().st_size // 2])

    assert run(["detect", str(picture)]) == 2

    said = capfd.readouterr().err
    assert said.startswith(f"error: {picture}: is no whole picture; ") and len(said.splitlines()) == 1


def test_a_picture_of_10_bits_in_16_is_warned_of_as_nearly_black(
    picture: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    dark = tmp_path / "dark.tif"
    cv2.imwrite(str(dark), cv2.imread(str(picture)).astype(np.uint16) * 4)

    assert run(["detect", str(dark), "--json"]) == 0

    warning = f"warning: {dark}: is nearly black: brightness 1."
    said = capfd.readouterr().err
    assert said.startswith(warning) and said.endswith("; a robot goes by 10 to 245\n")
    assert len(said.splitlines()) == 1


def test_the_further_pictures_of_a_file_are_said_to_be_left_out(
    picture: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    several = tmp_path / "several.tif"
    image = cv2.imread(str(picture))
    cv2.imwritemulti(str(several), [image, image, image])

    assert run(["detect", str(several), "--json"]) == 0

    said = capfd.readouterr().err
    assert said == f"warning: {several}: holds 3 pictures, of which the first alone is looked at\n"
