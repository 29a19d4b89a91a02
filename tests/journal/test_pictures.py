"""The map and the overlay show what happened."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from matplotlib.colors import to_rgb

from fieldnav.errors import OutputError
from fieldnav.journal.map import RunMap, draw_map
from fieldnav.journal.overlay import FEATURE, HELD_ROW, ROW, OverlayView, OverlayWriter, draw_overlay
from fieldnav.journal.phases import PHASE_COLOURS, phase_of
from fieldnav.messages import Image, RowLine

SOIL = np.full((180, 320, 3), (72, 96, 122), np.uint8)


def straight(length_m: float = 12.0) -> RunMap:
    x = np.linspace(0, length_m, 100)
    states = ["Forward.Follow.Tracking"] * 60 + ["Forward.Exit"] * 40
    lane = np.array([[0.0, 0.0], [length_m, 0.0]])
    return RunMap(np.stack([x, 0 * x], axis=-1), states, [lane], [lane + 0.35], lane[1:], lane[:1])


def pixels_near(image: Image, colour_bgr: tuple[int, ...]) -> int:
    return int((np.abs(image.astype(int) - colour_bgr).max(axis=-1) < 12).sum())


@pytest.mark.parametrize(
    ("state", "phase"),
    [
        ("Forward.Follow.Tracking", "Follow"),
        ("Backward.Follow.Coasting", "Coasting"),
        ("Forward.Sidestep.Crossing", "Sidestep"),
        ("Backward_Exit", "Exit"),
        ("Fault.Latched", "Fault"),
        ("Finished", "Other"),
    ],
)
def test_every_state_has_the_colour_of_its_innermost_phase(state: str, phase: str) -> None:
    assert phase_of(state) == phase


def test_the_path_on_the_map_has_the_colours_of_its_states(tmp_path: Path) -> None:
    draw_map(tmp_path / "map.png", straight())

    image = np.asarray(cv2.imread(str(tmp_path / "map.png")), np.uint8)
    seen = {
        phase
        for phase, colour in PHASE_COLOURS.items()
        if pixels_near(image, tuple(round(255 * part) for part in reversed(to_rgb(colour)))) > 500
    }
    assert {"Follow", "Exit"} <= seen
    assert not {"Sidestep", "Fault", "Paused"} & seen


@pytest.mark.parametrize("length_m", [4.0, 200.0])
def test_short_and_long_fields_give_a_map_of_readable_shape(length_m: float, tmp_path: Path) -> None:
    draw_map(tmp_path / "map.png", straight(length_m))

    height, width = np.asarray(cv2.imread(str(tmp_path / "map.png"))).shape[:2]
    assert 400 < height < width * 1.5


def test_a_run_that_never_moved_has_a_map_too(tmp_path: Path) -> None:
    draw_map(tmp_path / "map.png", RunMap(np.empty((0, 2)), []))
    draw_map(tmp_path / "point.png", RunMap(np.zeros((1, 2)), ["Idle"]))

    assert cv2.imread(str(tmp_path / "map.png")) is not None


def test_a_map_that_cannot_be_written_says_so(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written"):
        draw_map(tmp_path / "nowhere" / "map.png", straight())


def test_rows_seen_rows_kept_and_the_feature_are_told_apart() -> None:
    rows = (RowLine(60, 60), RowLine(250, 250, confidence=0.0))
    view = OverlayView(SOIL, "Forward.Follow.Tracking", 3.0, "front", rows, None, RowLine(160, 160))

    drawn = draw_overlay(view)

    for x, colour in ((60, ROW), (250, HELD_ROW), (160, FEATURE), (20, (72, 96, 122))):
        assert np.abs(drawn[120, x].astype(int) - colour).max() <= 20  # lines are drawn with soft edges


def test_no_row_is_drawn_into_the_sky() -> None:
    sky_px, written_px = 100, 40
    rows, feature = (RowLine(60, 60),), RowLine(160, 160)

    drawn = draw_overlay(OverlayView(SOIL, "Idle", 0.0, "front", rows, None, feature, sky_px=sky_px))

    assert np.array_equal(drawn[written_px : sky_px - 3], SOIL[written_px : sky_px - 3])
    for x, colour in ((60, ROW), (160, FEATURE)):
        assert np.abs(drawn[sky_px + 5, x].astype(int) - colour).max() <= 20


def test_drawing_leaves_the_picture_itself_alone() -> None:
    before = SOIL.copy()

    draw_overlay(OverlayView(SOIL, "Idle", 0.0, "front", (RowLine(10, 10),)))

    assert np.array_equal(SOIL, before)


def test_a_video_holds_every_picture_at_its_rate(tmp_path: Path) -> None:
    with OverlayWriter(tmp_path / "overlay.mp4", (320, 180), 15.0) as video:
        for number in range(5):
            video.write(draw_overlay(OverlayView(SOIL, "Idle", number / 15, "front")))

    assert (tmp_path / "overlay.mp4").stat().st_mode & 0o777 == 0o600
    opened = cv2.VideoCapture(str(tmp_path / "overlay.mp4"))
    assert (opened.get(cv2.CAP_PROP_FRAME_COUNT), opened.get(cv2.CAP_PROP_FPS)) == (5, 15)
    found, first = opened.read()
    opened.release()
    assert found
    assert np.abs(first[120:170].astype(int) - SOIL[120:170]).mean() < 6


def test_a_video_that_cannot_be_written_says_so(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="the video cannot be written"):
        OverlayWriter(tmp_path / "nowhere" / "overlay.mp4", (320, 180), 15.0)
