"""What was made of a recorded picture, ready to be drawn into it."""

from fieldnav.journal.entry import Line
from fieldnav.journal.overlay import OverlayView
from fieldnav.messages import RowLine, Twist
from fieldnav.recording.picture import Picture
from fieldnav.recording.records import Seen, Stepped


def seen_of(line: Line) -> Seen | None:
    """The frame that a line was decided on; None where none is named, or not as a journal names it."""
    try:
        return Seen.model_validate(line.frame) if line.frame else None
    except ValueError:
        return None


def seen_in(
    picture: Picture, step: Stepped | None, state: str, lane: int | None, command: Twist
) -> OverlayView:
    """The picture with the rows of the step that judged it, if any did, and what the wheels were told."""
    seen, rows = picture.seen, step.rows if step else ()
    return OverlayView(
        image=picture.image(),
        state=state,
        stamp_s=seen.stamp_s,
        camera=seen.camera.value,
        rows=[RowLine(row.x_top_px, row.x_bottom_px, row.confidence) for row in rows],
        command=command,
        lane="" if lane is None else f"lane {lane}",
    )
