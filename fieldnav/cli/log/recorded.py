"""What a recording knows of the time before a moment: what was judged, how the robot moved, what it saw."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from fieldnav.cli.log.chart import Course
from fieldnav.inquiry.quantities import OFFSET
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Judged
from fieldnav.journal.resolved import skies_px
from fieldnav.messages import CameraName
from fieldnav.recording.picture import Picture
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Gap, Seen, Stepped, Ticked

BEFORE_S = 30.0
"""The half minute before."""
AFTER_S = 0.01
"""The moment's own round, and not the next one 20 ms later."""


@dataclass(frozen=True, slots=True)
class Recorded:
    """The half minute before a moment; picture: the newest of those that were gone by.

    skies_px: how many image rows of each camera look above the horizon, where that is known.
    """

    steps: tuple[Stepped, ...]
    ticks: tuple[Ticked, ...]
    gaps: tuple[Gap, ...]
    step: Stepped | None
    picture: Picture | None
    skies_px: Mapping[CameraName, float]

    def judged(self, state: str) -> tuple[Judged, ...]:
        """What was judged last, if it was in that state."""
        newest = next((step for step in reversed(self.steps) if step.evidence), None)
        return newest.evidence if newest is not None and newest.state == state else ()


def recorded(directory: RunDirectory, at_s: float, seen: Seen | None) -> Recorded | None:
    """seen: the frame that decided. None without a recording. Raises FieldnavError for one that is none."""
    recording = Recording.open(directory)
    if recording is None:
        return None
    with recording:
        begin_s, end_s = at_s - BEFORE_S, at_s + AFTER_S
        steps = tuple(recording.steps(begin_s, end_s))
        gaps = tuple(gap for gap in recording.gaps() if gap.to_s >= begin_s and gap.from_s <= end_s)
        step = _on(steps, seen)
        frame = step.frame if step is not None else seen
        picture = recording.picture(frame) if frame is not None else None
        ticks = tuple(recording.ticks(begin_s, end_s))
        return Recorded(steps, ticks, gaps, step, picture, skies_px(directory.settings))


def _on(steps: tuple[Stepped, ...], seen: Seen | None) -> Stepped | None:
    """The step that judged the frame; without one the newest that judged any."""
    frames = [step for step in steps if step.frame is not None]
    if seen is not None:
        frames = [step for step in frames if step.frame == seen]
    return frames[-1] if frames else None


def courses(known: Recorded, conditions: tuple[Judged, ...]) -> Iterator[Course]:
    """The quantities named over the half minute, then the robot's speed and its place in the lane."""
    for judged in conditions:
        yield from _course(known.steps, judged.name, judged.threshold, judged.unit)
    if known.ticks:
        at_s = np.array([tick.now_s for tick in known.ticks])
        speed_mps = np.array([tick.told_mps for tick in known.ticks])
        yield Course("speed told to the wheels", at_s, speed_mps, None, "m/s")
    if OFFSET not in [judged.name for judged in conditions]:
        yield from _course(known.steps, OFFSET, None, "m")


def _course(steps: tuple[Stepped, ...], name: str, threshold: float | None, unit: str) -> Iterator[Course]:
    """None where it was not judged at least twice."""
    found = [
        (step.now_s, judged.value)
        for step in steps
        for judged in step.evidence
        if judged.name == name and judged.value is not None
    ]
    if len(found) > 1:
        at_s, value = np.array(found, dtype=float).T
        yield Course(name, at_s, value, threshold, unit)
