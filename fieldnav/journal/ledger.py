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
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field

from fieldnav.errors import FieldnavError, OutputError, SettingsError
from fieldnav.journal.entry import MAX_LANES, MAX_ROWS, MAX_STAMP_S, MAX_WAY_M
from fieldnav.journal.files import append_line, private, unwritable
from fieldnav.journal.ledger_lock import hold
from fieldnav.settings.json_text import read_model
from fieldnav.settings.regular_file import open_regular

LAST_BYTES = 65536
"""Of the file's end, in which a whole line is looked for: a hundred of them."""


Lane = Annotated[int, Field(ge=1, le=MAX_LANES)]
Way = Annotated[float, Field(ge=-MAX_WAY_M, le=MAX_WAY_M)]


class Booking(BaseModel):
    """One line: see states.place.Place; `finished` once the last lane has been left."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    stamp_s: float = Field(ge=0, le=MAX_STAMP_S)
    state: str
    side: Literal["right", "left"]
    lanes: Lane
    lane: Lane
    done: tuple[Lane, ...]
    rows: int = Field(ge=0, le=MAX_ROWS)
    forward_m: Way
    sideways_m: Way
    lane_from_m: Way | None = None
    lane_length_m: Way | None = None
    expected_m: Way | None = None
    pitches_m: tuple[Way, ...] = ()
    sidestep_from_m: Way | None = None
    finished: bool = False


class Ledger:
    """Appends bookings. One process holds a ledger at a time; a thread of its own syncs.

    Raises OutputError when the file cannot be written, or another process holds it.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._file = open(path, "ab", buffering=0, opener=private)  # noqa: SIM115 - closed by close
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
        with open_regular(path) as file:
            file.seek(max(0, file.seek(0, os.SEEK_END) - LAST_BYTES))
            content = file.read()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error
    lines = content[: content.rfind(b"\n") + 1].split(b"\n")[:-1]
    if not lines:
        return None
    try:
        return read_model(Booking, lines[-1])
    except SettingsError as error:
        raise FieldnavError(f"{path}: its last line is none of a ledger's: {error}") from error


def _whole_lines(path: Path) -> int:
    """Length of the file up to the end of its last whole line; what follows was never acted on."""
    size = path.stat().st_size
    with path.open("rb") as file:
        start = max(0, size - LAST_BYTES)
        file.seek(start)
        content = file.read()
    return start + content.rfind(b"\n") + 1
