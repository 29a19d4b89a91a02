"""The files of a recording one after another: a new one past a size, the oldest given up past a budget."""

import os
from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from fieldnav.errors import OutputError
from fieldnav.journal.directory import RunDirectory
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.piece import Opening, Piece
from fieldnav.recording.piece_names import piece_path, pieces_in
from fieldnav.settings.recording import RecordingSettings

BYTES_PER_MB = 1_000_000
BYTES_PER_GB = 1_000_000_000
LOOK_S = 1.0
"""How often the disk is synced and looked at, of the run's time: what a power loss may cost."""

REPEATED = (Topic.FRONT_CALIBRATION, Topic.REAR_CALIBRATION)
"""Said once in a run and needed in every file of it."""


def free_bytes(folder: Path) -> int:
    """What the disk of a folder has left for such as us. Raises OSError."""
    disk = os.statvfs(folder)
    return disk.f_bavail * disk.f_frsize


class Pieces:
    """Writes messages into one piece after another, going on after those there are.

    Raises OSError, and OutputError once the disk has too little left; then the last piece is complete.
    """

    def __init__(
        self,
        directory: RunDirectory,
        settings: RecordingSettings,
        begun_utc: datetime,
        opening: Opening,
        free: Callable[[Path], int],
    ) -> None:
        self._directory, self._settings, self._begun_utc = directory, settings, begun_utc
        self._opening, self._free = opening, free
        self._piece: Piece | None = None
        self._look_at_s = float("-inf")
        self._repeated: dict[Topic, Message] = {}
        self.notes: list[str] = []

    def write(self, message: Message) -> None:
        """Append one message."""
        if message.stamp_s >= self._look_at_s:
            self._look_at_s = message.stamp_s + LOOK_S
            self._look()
        if self._piece is None:
            self._piece = self._next(message.stamp_s)
        if message.topic in REPEATED:
            self._repeated[message.topic] = message
        self._piece.write(message)
        if self._piece.size_bytes > self._settings.piece_mb * BYTES_PER_MB:
            self.close()

    def close(self) -> None:
        """Complete the piece that is being written."""
        piece, self._piece = self._piece, None
        if piece is not None:
            piece.close()

    def abandon(self) -> None:
        """Leave the piece that is being written as it is; raises nothing."""
        piece, self._piece = self._piece, None
        if piece is not None:
            piece.abandon()

    def _next(self, stamp_s: float) -> Piece:
        number = max(pieces_in(self._directory), default=0) + 1
        piece = Piece(piece_path(self._directory, number), self._begun_utc, self._opening)
        for message in self._repeated.values():
            piece.write(Message(message.topic, stamp_s, message.data, message.sequence))
        return piece

    def _look(self) -> None:
        """Sync what was written, see to the budget and to the disk."""
        if self._piece is not None:
            self._piece.sync()
        self._keep_budget()
        allowed_gb = self._settings.keep_free_gb
        left_gb = self._free(self._directory.path) / BYTES_PER_GB
        if left_gb < allowed_gb:
            self.close()
            raise OutputError(
                f"{self._directory.path}: recording has ended: the disk has {left_gb:.1f} GB left; "
                f"robot.recording.keep_free_gb is {allowed_gb:g}"
            )

    def _keep_budget(self) -> None:
        paths = list(pieces_in(self._directory).values())
        sizes = [path.stat().st_size for path in paths]
        budget = self._settings.budget_gb
        while len(paths) > 1 and sum(sizes) > budget * BYTES_PER_GB:
            oldest = paths.pop(0)
            sizes.pop(0)
            oldest.unlink()
            self.notes.append(f"{oldest}: gave way to newer ones; robot.recording.budget_gb is {budget:g}")
