"""The rounds of a recording with their pictures."""

from collections.abc import Iterator
from dataclasses import dataclass

from drivers.compression import decoded
from drivers.module_link import ASKED, Missing
from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.messages import CameraName, Frame
from fieldnav.recording.piece import MOST_SEQUENCE
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Call, Round, Seen
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


def questions(recording: Recording) -> frozenset[Missing]:
    """What the modules were asked for again and again in the run.

    Recordings of before drive modes were set have no answers: nothing is then missing for want of one.
    """
    start = next((each for each in recording.rounds() if each.call is Call.START), None)
    if start is None:
        return ASKED
    sent = [wire_layout().heard(wire.message()) for wire in start.wires if wire.sent]
    modes = any(telegram is not None and telegram.kind is Kind.MODE for telegram in sent)
    return ASKED if modes else frozenset()


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
