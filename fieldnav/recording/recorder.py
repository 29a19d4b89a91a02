"""Writes a recording beside the loop, which pays for a place in a queue and for nothing else."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from threading import Thread
from types import TracebackType
from typing import Self

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.files import unwritable
from fieldnav.recording.leaving_out import LeavingOut
from fieldnav.recording.message import Recordable
from fieldnav.recording.piece import Opening, new_file
from fieldnav.recording.pieces import BYTES_PER_MB, Pieces, free_bytes
from fieldnav.recording.queue import BoundedQueue, Waiting
from fieldnav.settings.recording import RecordingSettings

CLOSING_S = 30.0
"""How long the end of a run waits for a disk to take what is still in the queue."""


class Recorder:
    """Records what it is given. Whatever goes wrong ends the recording and is said by `failure`."""

    def __init__(
        self,
        directory: RunDirectory,
        settings: RecordingSettings,
        begun_utc: datetime,
        waits: bool,
        opening: Opening = new_file,
        free: Callable[[Path], int] = free_bytes,
    ) -> None:
        """begun_utc: at second 0 of the run. waits: `put` waits for the disk, and nothing is left out."""
        self.failure: str | None = None
        self._directory = directory
        self._pieces = Pieces(directory, settings, begun_utc, opening, free)
        self._leaving_out = LeavingOut()
        self._queue = BoundedQueue(settings.queue_mb * BYTES_PER_MB, waits)
        self._thread = Thread(target=self._run, name="recorder", daemon=True)
        self._thread.start()

    @property
    def notes(self) -> tuple[str, ...]:
        """What a person should know of the recording: what was left out, what was given up."""
        return (*self._leaving_out.notes, *self._pieces.notes)

    def put(self, item: Recordable) -> None:
        """Have it written soon, in the order of the calls. Raises nothing."""
        self._queue.put(item)

    def close(self) -> None:
        """Write what waits and complete the file. Raises nothing."""
        self._queue.close()
        self._thread.join(CLOSING_S)
        if self._thread.is_alive():
            self.failure = f"{self._directory.path}: the recording's end was not written in {CLOSING_S:g} s"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _run(self) -> None:
        try:
            while (waiting := self._queue.get()) is not None:
                self._write(waiting)
                self._queue.done(waiting)
            self._end()
        except Exception as error:  # whatever it is: the mission goes on without a recording
            self.failure = self._said(error)
            self._queue.close()
            self._queue.clear()
        finally:
            self._pieces.abandon()

    def _write(self, waiting: Waiting) -> None:
        self._leaving_out.before(waiting)
        for message in waiting.item.messages():
            if waiting.item.picture and (gap := self._leaving_out.gap(message.stamp_s)):
                self._pieces.write(gap)
            self._pieces.write(message)
            self._leaving_out.written(message)

    def _end(self) -> None:
        self._leaving_out.left(*self._queue.close())
        if gap := self._leaving_out.gap():
            self._pieces.write(gap)
        self._pieces.close()

    def _said(self, error: Exception) -> str:
        if isinstance(error, OSError):
            return str(unwritable(self._directory.recording, error))
        if isinstance(error, FieldnavError):
            return str(error)
        return f"{self._directory.recording}: recording has ended: {type(error).__name__}: {error}"
