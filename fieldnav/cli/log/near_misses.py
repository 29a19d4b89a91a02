"""The events that nearly came about in a run, as far as its recording tells."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.recording.piece_names import pieces_in

if TYPE_CHECKING:
    from fieldnav.inquiry.near_misses import NearMiss

MOST = 10


@dataclass(frozen=True, slots=True)
class Missed:
    """The closest; lacking: why nothing is known of them."""

    misses: "tuple[NearMiss, ...]" = ()
    lacking: str = ""


def is_recorded(directory: RunDirectory) -> bool:
    """Whether there is a file of a recording; told without what it takes to read one."""
    return bool(pieces_in(directory))


def near_misses(directory: RunDirectory) -> Missed:
    """The closest of all that was judged."""
    if not is_recorded(directory):
        return Missed(lacking="near misses are not known: this run has no recording")
    from fieldnav.inquiry.near_misses import NearMisses  # noqa: PLC0415
    from fieldnav.recording.recording import Recording  # noqa: PLC0415 - slow to import, and often not needed

    try:
        recording = Recording.open(directory)
        if recording is None:
            return Missed(lacking="near misses are not known: this run has no recording")
        with recording:
            found = NearMisses()
            for step in recording.steps():
                found.add(step)
            return Missed(tuple(found.closest(MOST)))
    except FieldnavError as error:
        return Missed(lacking=f"near misses are not known: {error}")
