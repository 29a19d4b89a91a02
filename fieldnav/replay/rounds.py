"""The rounds of a recording with their pictures."""

from collections.abc import Iterator
from dataclasses import dataclass

from drivers.compression import decoded
from fieldnav.messages import CameraName, Frame
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Round, Seen

KEPT_S = 10.0
"""A picture is looked for among those no older than this before its round."""


@dataclass(frozen=True, slots=True)
class Taken:
    """One round with the frames that it took in; `lacking`: those whose pictures are not in the recording."""

    round: Round
    frames: tuple[Frame, ...]
    lacking: tuple[Seen, ...] = ()


def taken(recording: Recording) -> Iterator[Taken]:
    """All rounds in their order. Raises FieldnavError, DriverError for a picture that cannot be decoded."""
    pictures = recording.pictures()
    waiting: dict[tuple[CameraName, int], tuple[float, bytes]] = {}
    at_s = -float("inf")
    for each in recording.rounds():
        while at_s <= each.now_s and any((seen.camera, seen.sequence) not in waiting for seen in each.frames):
            picture = next(pictures, None)
            if picture is None:
                break
            at_s = picture.seen.stamp_s
            waiting[picture.seen.camera, picture.seen.sequence] = (at_s, picture.jpeg)
        frames, lacking = [], []
        for seen in each.frames:
            found = waiting.pop((seen.camera, seen.sequence), None)
            if found is None:
                lacking.append(seen)
            else:
                frames.append(Frame(seen.camera, seen.sequence, seen.stamp_s, decoded(found[1]), found[1]))
        waiting = {key: kept for key, kept in waiting.items() if kept[0] > each.now_s - KEPT_S}
        yield Taken(each, tuple(frames), tuple(lacking))
