"""What a recording lacks of its run, without which a replay cannot be compared bit for bit."""

from collections.abc import Mapping

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.moment import clock
from fieldnav.journal.entry import Line
from fieldnav.recording.records import Call
from fieldnav.replay.rounds import Taken


class Completeness:
    """Takes in round after round, and says in the end what was not among them."""

    def __init__(self, lines: Mapping[int, Line]) -> None:
        """lines: the journal's, by their numbers."""
        self._missing = dict(lines)
        self._pictures = self._rounds = 0
        self._number: int | None = None
        self._before: Call | None = None

    def take(self, taken: Taken) -> None:
        """Raises FieldnavError for a recording whose beginning is gone, or that has two."""
        call = taken.round.call
        if self._number is None and call not in (Call.START, Call.TAKE_UP):
            raise FieldnavError(
                f"the recording begins at {clock(taken.round.now_s)}, its beginning is gone; allowed is one "
                "that begins with its run (see robot.recording.budget_gb)"
            )
        if call is Call.START and self._before not in (None, Call.TAKE_UP):
            raise FieldnavError(
                f"the recording begins once more at {clock(taken.round.now_s)}; "
                "allowed are the files of one run"
            )
        self._before = call
        if call is not Call.TAKE_UP and self._number is not None:  # a new process counts anew
            self._rounds += max(0, taken.round.number - self._number - 1)
        self._number = taken.round.number
        self._pictures += len(taken.lacking)
        for seq in taken.round.lines:
            self._missing.pop(seq, None)

    def said(self, to_the_end: bool = True) -> list[str]:
        """A sentence for each thing that lacks; to_the_end: all rounds of the recording were taken in."""
        said = []
        if self._pictures:
            said.append(f"{self._pictures} pictures are not in the recording")
        if self._rounds:
            said.append(f"{self._rounds} rounds are not in the recording")
        if self._missing and to_the_end:
            first = min(self._missing.values(), key=lambda line: line.seq)
            said.append(
                f"{len(self._missing)} lines of the journal, the first at {clock(first.stamp_s)}, "
                "are not in the recording"
            )
        return said
