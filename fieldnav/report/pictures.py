"""Finds the recorded frame of a moment, and draws what the robot saw into it."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.seen import seen_in, seen_of
from fieldnav.journal.entry import Line
from fieldnav.journal.overlay import draw_overlay
from fieldnav.messages import STANDSTILL, CameraName, Twist
from fieldnav.recording.picture import Picture
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Seen, Stepped
from fieldnav.report.embedded import Shown, shown

BEFORE_S = 3.0
"""A picture so much older than the stop still shows what the robot stood before."""
JUST_BEFORE_S = 0.2
"""Some ticks."""
AT_ONCE_S = 0.001


@dataclass(frozen=True, slots=True)
class Moment:
    """When a picture is shown for, in which state and lane, and what the wheels were told until then."""

    stamp_s: float
    state: str
    lane: int | None
    command: Twist


class Pictures:
    """Finds the pictures of moments; without a recording there are none."""

    def __init__(self, recording: Recording | None, skies_px: Mapping[CameraName, float]) -> None:
        """skies_px: how many image rows of each camera look above the horizon, where that is known."""
        self._recording, self._skies_px = recording, skies_px

    def of_step(self, step: Stepped) -> Shown | None:
        """What was judged in a step; None when its frame was not recorded."""
        try:
            found = self._picture(step.frame) if step.frame else None
            moment = Moment(step.now_s, step.state, step.lane, self._command(step.now_s))
            return self._shown(found, step, moment) if found else None
        except FieldnavError:  # a damaged picture costs itself, no more
            return None

    def of_line(self, line: Line) -> Shown | None:
        """The frame that a line was decided on; where it names none, the newest before it, judged or not."""
        try:
            step, seen = self._step_of(line), seen_of(line)
            found = (self._picture(seen) if seen else None) or self._newest(line.stamp_s, step)
            same = step if step and found and _is(step.frame, found.seen) else None
            moment = Moment(line.stamp_s, line.source, line.lane, self._command(line.stamp_s))
            return self._shown(found, same, moment) if found else None
        except FieldnavError:
            return None

    def step_of(self, line: Line) -> Stepped | None:
        """The step that saw the line's frame; for a line without one, the last before it that saw any."""
        try:
            return self._step_of(line)
        except FieldnavError:
            return None

    def _step_of(self, line: Line) -> Stepped | None:
        if self._recording is None:
            return None
        steps = [
            step
            for step in self._recording.steps(line.stamp_s - BEFORE_S, line.stamp_s + AT_ONCE_S)
            if step.frame is not None
        ]
        seen = seen_of(line)
        same = [step for step in steps if seen and _is(step.frame, seen)]
        return same[-1] if same else (steps[-1] if steps and seen is None else None)

    def _picture(self, seen: Seen) -> Picture | None:
        return self._recording.picture(seen) if self._recording else None

    def _command(self, stamp_s: float) -> Twist:
        """What the wheels were told last before a time."""
        ticks = self._recording.ticks(stamp_s - JUST_BEFORE_S, stamp_s - AT_ONCE_S) if self._recording else ()
        last = next(reversed(list(ticks)), None)
        return last.told if last else STANDSTILL

    def _newest(self, stamp_s: float, step: Stepped | None) -> Picture | None:
        """Of the camera that was gone by, where that is known."""
        camera = step.frame.camera if step and step.frame else None
        newest = None
        for picture in self._recording.pictures(stamp_s - BEFORE_S, stamp_s) if self._recording else ():
            newest = picture if camera in (None, picture.seen.camera) else newest
        return newest

    def _shown(self, found: Picture, step: Stepped | None, moment: Moment) -> Shown:
        view = seen_in(found, step, moment.state, moment.lane, moment.command, self._skies_px)
        caption = f"{found.seen.camera.value} camera at {clock(found.seen.stamp_s)}"
        if step is None:
            caption += ", not judged"
        ago_s = moment.stamp_s - found.seen.stamp_s
        return shown(draw_overlay(view), f"{caption}{_ago(ago_s)}")


def _ago(ago_s: float) -> str:
    """How much older than the moment a picture is, where that is worth a word."""
    return f", {ago_s:.1f} s before" if 1 <= ago_s < inf else ""


def _is(frame: Seen | None, seen: Seen) -> bool:
    return frame is not None and (frame.camera, frame.sequence) == (seen.camera, seen.sequence)
