"""overlay.mp4: the guiding camera's pictures with what the robot saw and decided drawn in."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import degrees
from pathlib import Path
from types import TracebackType
from typing import Self

import cv2
import numpy as np

from fieldnav.errors import OutputError
from fieldnav.journal.files import private
from fieldnav.messages import STANDSTILL, Centres, Image, RowLine, Twist

ROW, HELD_ROW, FEATURE, CENTRE, TEXT = (
    (60, 230, 60),
    (60, 200, 255),
    (255, 90, 220),
    (230, 60, 230),
    (255, 255, 255),
)
"""Colours, blue green red: rows seen, rows kept from earlier frames, the average line, plants, writing."""

CODEC = "mp4v"
BAR = 0.13
"""Height of the dark bar at the top, over the image's height."""

BAR_BRIGHTNESS = 0.3


@dataclass(frozen=True, slots=True)
class OverlayView:
    """One picture and what was made of it. `feature` is the average line that the robot steers by.

    sky_px: how many image rows look above the horizon; no row is drawn there.
    """

    image: Image
    state: str
    stamp_s: float
    camera: str
    rows: Sequence[RowLine] = ()
    centres: Centres | None = None
    feature: RowLine | None = None
    command: Twist = STANDSTILL
    lane: str = ""
    note: str = ""
    sky_px: float = 0.0


def draw_overlay(view: OverlayView) -> Image:
    """A copy of the picture with rows, plants, the average line, state and command drawn in."""
    canvas = view.image.copy()
    thickness = max(1, round(canvas.shape[1] / 426))
    for row in view.rows:
        _line(canvas, row, view.sky_px, ROW if row.confidence > 0 else HELD_ROW, thickness)
    if view.centres is not None:
        for x, y in np.rint(view.centres.position_px).astype(int).tolist():
            cv2.circle(canvas, (x, y), 2 * thickness, CENTRE, -1, cv2.LINE_AA)
    if view.feature is not None:
        _line(canvas, view.feature, view.sky_px, FEATURE, 2 * thickness)
    _head_up_display(canvas, view, thickness)
    return canvas


class OverlayWriter:
    """Writes pictures of one size into a video; `close` completes the file. Raises OutputError."""

    def __init__(self, path: Path, size_px: tuple[int, int], rate_hz: float) -> None:
        self._size_px = size_px
        with suppress(OSError), open(path, "xb", opener=private):
            pass  # the writer keeps the mode of a file that exists
        self._video = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*CODEC), rate_hz, size_px)
        if not self._video.isOpened():
            raise OutputError(f"{path}: the video cannot be written; allowed is a folder you can write")

    def write(self, image: Image) -> None:
        """Append a picture, shape (height, width, 3), blue green red; one of another size is scaled."""
        if (image.shape[1], image.shape[0]) != self._size_px:
            image = cv2.resize(image, self._size_px).astype(np.uint8)
        self._video.write(image)

    def close(self) -> None:
        self._video.release()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _line(canvas: Image, row: RowLine, from_px: float, colour: tuple[int, int, int], thickness: int) -> None:
    last = canvas.shape[0] - 1
    top, bottom = (round(row.at(from_px, last)), round(from_px)), (round(row.x_bottom_px), last)
    cv2.line(canvas, top, bottom, colour, thickness, cv2.LINE_AA)


def _head_up_display(canvas: Image, view: OverlayView, thickness: int) -> None:
    height, width = canvas.shape[:2]
    bar = round(height * BAR)
    canvas[:bar] = (canvas[:bar] * BAR_BRIGHTNESS).astype(np.uint8)
    first = "   ".join(part for part in (view.state, view.lane, f"rows {len(view.rows)}") if part)
    command = view.command
    second = (
        f"{view.stamp_s:7.1f} s   {view.camera}   vx {command.vx_mps:+.2f}  vy {command.vy_mps:+.2f} m/s  "
        f"yaw {degrees(command.yaw_rate_rps):+.1f} deg/s   {view.note}"
    )
    margin = round(width * 0.015)
    _write(canvas, first, (margin, round(bar * 0.45)), bar * 0.38, 2 * thickness // 2)
    _write(canvas, second, (margin, round(bar * 0.87)), bar * 0.27, max(1, thickness // 2))


def _write(canvas: Image, text: str, at: tuple[int, int], height_px: float, thickness: int) -> None:
    scale = cv2.getFontScaleFromHeight(cv2.FONT_HERSHEY_SIMPLEX, max(round(height_px), 6), thickness)
    cv2.putText(canvas, text, at, cv2.FONT_HERSHEY_SIMPLEX, scale, TEXT, thickness, cv2.LINE_AA)
