"""The rounds of a recording with their pictures."""

from collections.abc import Iterator
from dataclasses import dataclass

from drivers.compression import decoded
from fieldnav.messages import CameraName, Frame
from fieldnav.recording.piece import MOST_SEQUENCE
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Round, Seen
from fieldnav.recording.stamps import NS_PER_S

KEPT_S = 10.0
"""A picture is looked for among those no older than this before its round."""
AHEAD_S = 1.0
"""A camera's clock may be so much ahead of the loop's."""

Key = tuple[CameraName, int, int]
"""Of a frame: its camera, its number, which another process counts anew, and its stamp in nanoseconds."""


@dataclass(frozen=True, slots=True)
class Taken:
    """One round with the frames that it took in; `lacking`: those whose pictures are not in the recording."""

    round: Round
    frames: tuple[Frame, ...]
    lacking: tuple[Seen, ...] = ()


def taken(recording: Recording) -> Iterator[Taken]:
    """All rounds in their order. Raises FieldnavError, DriverError for a picture that cannot be decoded."""
    pictures = recording.pictures()
    waiting: dict[Key, tuple[float, bytes]] = {}
    at_s = -float("inf")
    for each in recording.rounds():
        wanted = {_key(seen) for seen in each.frames}
        while at_s <= each.now_s + AHEAD_S and not wanted <= waiting.keys():
            picture = next(pictures, None)
            if picture is None:
                break
            at_s = picture.seen.stamp_s
            waiting[_key(picture.seen)] = (at_s, picture.jpeg)
        frames, lacking = [], []
        for seen in each.frames:
            found = waiting.pop(_key(seen), None)
            if found is None:
                lacking.append(seen)
            else:
                frames.append(Frame(seen.camera, seen.sequence, seen.stamp_s, decoded(found[1]), found[1]))
        waiting = {key: kept for key, kept in waiting.items() if kept[0] > each.now_s - KEPT_S}
        yield Taken(each, tuple(frames), tuple(lacking))


def _key(seen: Seen) -> Key:
    """As far as it is recorded with the picture."""
    return seen.camera, seen.sequence & MOST_SEQUENCE, round(seen.stamp_s * NS_PER_S)
