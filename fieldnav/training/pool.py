"""The pool: a folder of drawn pictures in chunks, drawn by processes of its own while training goes on.

A chunk is written under another name and renamed, so that a chunk of the right name is whole.
"""

import multiprocessing
import os
import signal
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.process import BaseProcess
from pathlib import Path
from zipfile import BadZipFile

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.errors import OutputError, SettingsError
from fieldnav.training.drawn_picture import draw

CHUNK_PICTURES = 1000  # about 86 MB
SEEDS = 10_000_000  # pictures of one pool's seed; the first of them are left for tests and for looking at


@dataclass(frozen=True, slots=True)
class Chunk:
    """Drawn pictures: images (n, 128, 192, 3), uint8; heat (n, 64, 96), uint8; ignored (n, 64, 96), bool."""

    images: NDArray[np.uint8]
    heat: NDArray[np.uint8]
    ignored: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.images)


@dataclass(frozen=True, slots=True)
class Pool:
    """A folder of `chunks` chunks, numbered from 0, whose pictures are those of a seed."""

    folder: Path
    seed: int
    chunks: int
    chunk_pictures: int = CHUNK_PICTURES

    @property
    def held_out(self) -> int:
        """Number of the chunk that is never trained on."""
        return self.chunks - 1

    def path(self, number: int) -> Path:
        """Where a chunk is or will be."""
        return self.folder / f"seed{self.seed}-chunk{number:04d}.npz"

    def drawn(self) -> list[int]:
        """Numbers of the chunks that exist."""
        return [number for number in range(self.chunks) if self.path(number).exists()]

    def missing(self) -> list[int]:
        """Numbers of the chunks still to be drawn, the held-out one first: no training can do without it."""
        drawn = set(self.drawn())
        order = [self.held_out, *range(self.held_out)]
        return [number for number in order if number not in drawn]

    def draw_chunk(self, number: int) -> None:
        """Draw a chunk and write it."""
        first = (self.seed + 1) * SEEDS + number * self.chunk_pictures
        pictures = [draw(first + index) for index in range(self.chunk_pictures)]
        partial = self.path(number).with_suffix(".partial")
        with partial.open("wb") as file:
            np.savez(
                file,
                images=np.stack([picture.image for picture in pictures]),
                heat=np.stack([picture.heat for picture in pictures]),
                ignored=np.stack([picture.ignored for picture in pictures]),
            )
        partial.replace(self.path(number))

    def load(self, number: int) -> Chunk:
        """Read a chunk; raises SettingsError for a file that is none."""
        path = self.path(number)
        try:
            with np.load(path) as arrays:
                chunk = Chunk(arrays["images"], arrays["heat"], arrays["ignored"])
        except (OSError, ValueError, KeyError, BadZipFile) as error:
            raise SettingsError(
                f"{path} is no chunk of drawn pictures; remove it to have it drawn again"
            ) from error
        if len(chunk) != self.chunk_pictures:
            raise SettingsError(f"{path} holds {len(chunk)} pictures, not {self.chunk_pictures}; remove it")
        return chunk


@contextmanager
def drawing(pool: Pool, processes: int) -> Iterator["Drawers"]:
    """Draw the missing chunks in other processes, which end with the context; raises OutputError."""
    try:
        pool.folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the pool's folder {pool.folder}: {error.strerror}") from error
    if not os.access(pool.folder, os.W_OK):
        raise OutputError(f"cannot write to the pool's folder {pool.folder}")
    drawers = Drawers(pool, processes)
    try:
        yield drawers
    finally:
        drawers.stop()


class Drawers:
    """Processes that share the missing chunks of a pool."""

    def __init__(self, pool: Pool, processes: int) -> None:
        context = multiprocessing.get_context("spawn")  # a fork would copy PyTorch's threads in any state
        missing = pool.missing()
        shares = [missing[first::processes] for first in range(processes)]
        self._processes: list[BaseProcess] = [
            context.Process(target=_draw_chunks, args=(pool, share), daemon=True) for share in shares if share
        ]
        for process in self._processes:
            process.start()

    def check(self) -> None:
        """Raise OutputError when a process has failed; its own message is on standard error."""
        for process in self._processes:
            if process.exitcode:
                raise OutputError(f"a process that drew pictures ended with status {process.exitcode}")

    def wait(self) -> None:
        """Wait until every process has ended."""
        for process in self._processes:
            process.join()

    def stop(self) -> None:
        """End the processes; what they have not written is drawn by the next run."""
        for process in self._processes:
            process.terminate()
        self.wait()


def _draw_chunks(pool: Pool, numbers: Iterable[int]) -> None:
    """The work of one process; the parent ends it, so that Ctrl-C prints one message only."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    cv2.setNumThreads(1)
    for number in numbers:
        pool.draw_chunk(number)
