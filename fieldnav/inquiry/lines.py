"""A journal read in places: the newest lines first, or one found by halving, whatever the file's length."""

from collections.abc import Callable, Iterator
from io import SEEK_END
from pathlib import Path
from typing import Self

from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.inquiry.line_head import order_of
from fieldnav.journal.entry import Line
from fieldnav.settings.json_text import read_model
from fieldnav.settings.regular_file import open_regular

BLOCK_BYTES = 8192
"""Of one look into the file: some lines."""
STRETCH_BYTES = 1 << 20
"""Of one reading where many lines are wanted, reached by doubling: often only a few are."""
Placed = tuple[int, bytes]
"""A line as it stands in the file, without its end, and the byte at which it begins."""


class JournalLines:
    """An open journal up to its `end`; `parsed`, `bytes_read`: the work done on it. Raises FieldnavError.

    A line torn by power loss is left out. Read, not mapped: a run that is resumed cuts its torn line off,
    and touching what was mapped there would end the process.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self.parsed = self.bytes_read = 0
        try:
            self._file = open_regular(path)
            whole = self._file.seek(0, SEEK_END)
        except OSError as error:
            raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error
        self.end = self._start_of(whole)
        try:
            self.last = self._newest(torn=self.end != whole)
        except FieldnavError:
            self._file.close()
            raise

    def _newest(self, torn: bool) -> Line | None:
        """The last line; one that is none, at the very end of the file, counts as torn."""
        for newest in self.backwards():
            try:
                return self.parse(newest)
            except FieldnavError:
                if torn:
                    raise
            self.end, torn = newest[0], True
        return None

    def backwards(self, end: int | None = None, begin: int = 0) -> Iterator[Placed]:
        """The lines between two line starts, the last one first."""
        at = self.end if end is None else end
        tail = b""  # of a line whose beginning lies before what has been read
        length = BLOCK_BYTES
        while at > begin:
            start, length = max(begin, at - length), min(2 * length, STRETCH_BYTES)
            stretch = self._read(start, at - start) + tail
            first, *texts = stretch[:-1].split(b"\n")
            place = start + len(stretch)
            for text in reversed(texts):
                place -= len(text) + 1
                yield place, text
            tail, at = first + b"\n", start
        if tail:
            yield begin, tail[:-1]

    def forwards(self, begin: int = 0) -> Iterator[Placed]:
        """The lines from a line start on, the first one first."""
        place = at = begin
        head = b""  # of a line whose end lies behind what has been read
        length = BLOCK_BYTES
        while at < self.end:
            stretch = head + self._read(at, min(length, self.end - at))
            at, length = place + len(stretch), min(2 * length, STRETCH_BYTES)
            *texts, head = stretch.split(b"\n")
            for text in texts:
                yield place, text
                place += len(text) + 1

    def find(self, past: Callable[[int, float], bool]) -> int:
        """Where the first line begins whose number and stamp are past what is asked; else the end.

        Both rise from line to line, also in a run that was resumed.
        """
        low, high = 0, self.end
        while low < high:
            start = self._start_of((low + high) // 2)
            text = self._text(start)
            if past(*self._order(start, text)):
                high = start
            else:
                low = start + len(text) + 1
        return low

    def parse(self, placed: Placed) -> Line:
        """Raises FieldnavError, naming the line, for one that is none of a journal's."""
        start, text = placed
        self.parsed += 1
        try:
            return read_model(Line, text)
        except SettingsError as error:
            number = sum(1 for _ in self.backwards(start)) + 1
            said = f"{self._path}: line {number} is not a line of a journal"
            raise FieldnavError(f"{said}: {error}") from error

    def _order(self, start: int, text: bytes) -> tuple[int, float]:
        order = order_of(text)
        if order is not None:
            return order
        line = self.parse((start, text))
        return line.seq, line.stamp_s

    def _start_of(self, at: int) -> int:
        """Where the line begins that the byte before `at` does not end."""
        while at > 0:
            start = max(0, at - BLOCK_BYTES)
            found = self._read(start, at - start).rfind(b"\n")
            if found >= 0:
                return start + found + 1
            at = start
        return 0

    def _text(self, start: int) -> bytes:
        """The line that begins there, without its end."""
        text, at = b"", start
        while at < self.end:
            block, ended, _ = self._read(at, BLOCK_BYTES).partition(b"\n")
            text += block
            if ended:
                break
            at += BLOCK_BYTES
        return text

    def _read(self, start: int, length: int) -> bytes:
        self._file.seek(start)
        content = self._file.read(length)
        self.bytes_read += len(content)
        return content

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        self._file.close()
