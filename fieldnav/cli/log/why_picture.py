"""The frame that decided, with what was seen in it, and beneath it what happened and why."""

from collections.abc import Sequence
from pathlib import Path
from textwrap import wrap

import cv2
import numpy as np

from fieldnav.cli.log.recorded import Recorded
from fieldnav.errors import OutputError
from fieldnav.inquiry.seen import seen_in
from fieldnav.inquiry.words import judgement
from fieldnav.journal.entry import Judged
from fieldnav.journal.files import write_atomically
from fieldnav.journal.overlay import OverlayView, draw_overlay
from fieldnav.messages import STANDSTILL, Image
from fieldnav.recording.picture import Picture

LINE_HEIGHT = 0.035
"""Of the picture's height: one line of the caption."""
LETTER = 0.6
"""Of a line's height: a capital letter."""
LETTERS_A_LINE = 110
PAPER, INK, FAINT = (32, 32, 32), (255, 255, 255), (190, 190, 190)
QUALITY = 90


def save_picture(path: Path, known: Recorded, headline: str, judged: Sequence[Judged]) -> None:
    """Write the frame with its overlay and caption, if there is one. Raises FieldnavError, OutputError."""
    if known.picture is None:
        return
    image = _captioned(draw_overlay(_view(known, known.picture)), headline, [*map(judgement, judged)])
    encoded, content = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
    if not encoded:
        raise OutputError(f"{path}: the picture cannot be written")
    write_atomically(path, content.tobytes())


def _view(known: Recorded, picture: Picture) -> OverlayView:
    """What the mission made of the picture, and what it told the wheels then."""
    step = known.step
    told = next((tick for tick in known.ticks if step is None or tick.now_s >= step.now_s), None)
    state, lane = (step.state, step.lane) if step else ("", None)
    return seen_in(picture, step, state, lane, told.told if told else STANDSTILL, known.skies_px)


def _captioned(image: Image, headline: str, judged: Sequence[str]) -> Image:
    """The picture with the headline, then the quantities in two columns, beneath it."""
    lines = wrap(headline, LETTERS_A_LINE)
    step_px = round(image.shape[0] * LINE_HEIGHT)
    rows = len(lines) + (len(judged) + 1) // 2
    caption = np.full((step_px * (rows + 1), image.shape[1], 3), PAPER, np.uint8)
    for number, text in enumerate(lines, start=1):
        _write(caption, text, (step_px // 2, number * step_px), step_px, INK)
    for index, text in enumerate(judged):
        place = (step_px // 2 + index % 2 * image.shape[1] // 2, (len(lines) + 1 + index // 2) * step_px)
        _write(caption, text, place, step_px, FAINT)
    return np.vstack([image, caption])


def _write(
    caption: Image, text: str, place: tuple[int, int], step_px: int, colour: tuple[int, int, int]
) -> None:
    scale = cv2.getFontScaleFromHeight(cv2.FONT_HERSHEY_SIMPLEX, round(step_px * LETTER), 1)
    shown = text.encode("ascii", "replace").decode()  # OpenCV has no other letters
    cv2.putText(caption, shown, place, cv2.FONT_HERSHEY_SIMPLEX, scale, colour, 1, cv2.LINE_AA)
