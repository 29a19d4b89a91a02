"""What was made of a recorded picture, ready to be drawn into it."""

from collections.abc import Mapping

from fieldnav.journal.entry import Line
from fieldnav.journal.overlay import OverlayView
from fieldnav.messages import CameraName, RowLine, Twist
from fieldnav.recording.picture import Picture
from fieldnav.recording.records import Seen, Stepped


def seen_of(line: Line) -> Seen | None:
    """The frame that a line was decided on; None where none is named, or not as a journal names it."""
    try:
        return Seen.model_validate(line.frame) if line.frame else None
    except ValueError:
        return None


def seen_in(
    picture: Picture,
    step: Stepped | None,
    state: str,
    lane: int | None,
    command: Twist,
    skies_px: Mapping[CameraName, float],
) -> OverlayView:
    """The picture with the rows of the step that judged it, if any did, and what the wheels were told.

    skies_px: how many image rows of each camera look above the horizon, where that is known.
    """
    seen, rows = picture.seen, step.rows if step else ()
    return OverlayView(
        image=picture.image(),
        state=state,
        stamp_s=seen.stamp_s,
        camera=seen.camera.value,
        rows=[RowLine(row.x_top_px, row.x_bottom_px, row.confidence) for row in rows],
        command=command,
        lane="" if lane is None else f"lane {lane}",
        sky_px=skies_px.get(seen.camera, 0.0),
    )
