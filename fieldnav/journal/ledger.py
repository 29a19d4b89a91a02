"""The ledger: which lanes are done and where the robot is, on the disk before the wheels obey.

A line is appended at every transition and every few decimetres; only the last whole one counts. Those at
transitions are synced before the wheels obey. Those between are handed to the system before they obey, which
a killed process cannot undo, and synced beside the loop: a power loss may cost the last of them.
"""

import os
from concurrent.futures import Future, ThreadPoolExecutor
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Self

from pydantic import BaseModel, ConfigDict, ValidationError

from fieldnav.errors import FieldnavError, OutputError
from fieldnav.journal.files import append_line, unwritable
from fieldnav.journal.ledger_lock import hold

LAST_BYTES = 65536
"""Of the file's end, in which a whole line is looked for: a hundred of them."""


class Booking(BaseModel):
    """One line: see states.place.Place; `finished` once the last lane has been left."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    stamp_s: float
    state: str
    side: str
    lanes: int
    lane: int
    done: tuple[int, ...]
    rows: int
    forward_m: float
    sideways_m: float
    lane_from_m: float | None = None
    lane_length_m: float | None = None
    expected_m: float | None = None
    pitches_m: tuple[float, ...] = ()
    sidestep_from_m: float | None = None
    finished: bool = False


class Ledger:
    """Appends bookings. One process holds a ledger at a time; a thread of its own syncs.

    Raises OutputError when the file cannot be written, or another process holds it.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._file = path.open("ab", buffering=0)
        except OSError as error:
            raise unwritable(path, error) from error
        try:
            hold(self._file)
        except OSError as error:
            self._file.close()
            raise OutputError(f"{path}: another fieldnav drives this run") from error
        self._file.truncate(_whole_lines(path))
        self._beside = ThreadPoolExecutor(1, thread_name_prefix="ledger")
        self._syncing: Future[None] | None = None

    def book(self, booking: Booking, synced: bool = True) -> None:
        """Append one line; `synced`: on return it is on the disk, else soon after. Raises OutputError."""
        content = booking.model_dump_json(exclude_defaults=True).encode()
        try:
            append_line(self._file, content, partial(self._sync, synced))
        except OSError as error:
            raise unwritable(self._path, error) from error

    def _sync(self, at_once: bool) -> None:
        """Raises OSError, also that of an earlier sync beside the loop."""
        if at_once:
            os.fdatasync(self._file.fileno())
        elif self._syncing is None or self._syncing.done():
            done, self._syncing = self._syncing, self._beside.submit(os.fdatasync, self._file.fileno())
            if done is not None:
                done.result()

    def close(self) -> None:
        self._beside.shutdown()
        self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def last_booking(path: Path) -> Booking | None:
    """The newest whole line of a ledger; None where there is no ledger or no line. Raises FieldnavError."""
    try:
        with path.open("rb") as file:
            file.seek(max(0, path.stat().st_size - LAST_BYTES))
            content = file.read()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error
    lines = content[: content.rfind(b"\n") + 1].split(b"\n")[:-1]
    if not lines:
        return None
    try:
        return Booking.model_validate_json(lines[-1])
    except ValidationError as error:
        raise FieldnavError(f"{path}: its last line is none of a ledger's") from error


def _whole_lines(path: Path) -> int:
    """Length of the file up to the end of its last whole line; what follows was never acted on."""
    size = path.stat().st_size
    with path.open("rb") as file:
        start = max(0, size - LAST_BYTES)
        file.seek(start)
        content = file.read()
    return start + content.rfind(b"\n") + 1
