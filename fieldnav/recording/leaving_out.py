"""What was left out because the disk was too slow: from when to when, and how much."""

from fieldnav.recording.message import Message, Topic
from fieldnav.recording.queue import Waiting
from fieldnav.recording.records import Gap


class LeavingOut:
    """Sees all that is written; a gap reaches from the last message before it to the next picture."""

    def __init__(self) -> None:
        self._from_s: float | None = None
        self._last_s = 0.0
        self._in_gap = self._pictures = self._others = 0
        self._first_s: float | None = None

    @property
    def notes(self) -> tuple[str, ...]:
        """One line, if anything was left out."""
        if self._first_s is None:
            return ()
        others = f" and {self._others} records without which it cannot be replayed" if self._others else ""
        return (
            f"the disk is too slow: from {self._first_s:.1f} s on "
            f"{self._pictures} pictures{others} are not in the recording",
        )

    def before(self, waiting: Waiting) -> None:
        """Note what was left out before this one."""
        self.left(waiting.pictures_before, waiting.others_before)

    def left(self, pictures: int, others: int) -> None:
        """So many were left out after what was last written."""
        if pictures and self._from_s is None:
            self._from_s = self._last_s
        if pictures + others and self._first_s is None:
            self._first_s = self._last_s
        self._in_gap += pictures
        self._pictures += pictures
        self._others += others

    def written(self, message: Message) -> None:
        """This has found its place in the recording."""
        self._last_s = max(self._last_s, message.stamp_s)

    def gap(self, until_s: float = 0.0) -> Message | None:
        """The gap that ends here, if there is one."""
        if self._from_s is None:
            return None
        gap = Gap(from_s=self._from_s, to_s=max(self._last_s, until_s), frames=self._in_gap)
        self._from_s, self._in_gap = None, 0
        return Message(Topic.GAP, gap.to_s, gap.model_dump_json().encode())
