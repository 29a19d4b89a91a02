"""The lock on a run's ledger: whoever holds it drives the run."""

import fcntl
import time
from contextlib import suppress
from io import BufferedIOBase, RawIOBase
from pathlib import Path

from fieldnav.settings.regular_file import open_regular

TRIES, ASKING_S = 3, 0.01
"""Who only asks whether a run is driven holds its ledger for far less than this. Our choice."""

File = BufferedIOBase | RawIOBase


def hold(file: File) -> None:
    """Lock the file, also past those who just then ask who drives. Raises OSError where somebody does."""
    for _ in range(TRIES):
        with suppress(BlockingIOError):
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return
        time.sleep(ASKING_S)
    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def being_driven(ledger: Path) -> bool:
    """Whether a process holds the ledger, so that its run still goes on; asking holds it for a moment."""
    try:
        with open_regular(ledger) as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:  # there is none, or it is on a disk that knows no locks
        return False
    return False
