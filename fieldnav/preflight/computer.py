"""What is read of the computer that the mission runs on."""

import os
import shutil
import tempfile
import time
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import fieldnav

TIME_SYNC = Path("/run/systemd/timesync")
SYNCHRONISED = "synchronized"
"""systemd makes this file in TIME_SYNC once it has heard a time server."""


@dataclass(frozen=True, slots=True)
class Computer:
    """Readings of one moment.

    refusal: why nothing can be written where runs go, empty where it can; installed: when this software was;
    tick_s: resolution of the monotonic clock; synchronised: None where nobody tells; load: processes that
    want to run, the last minute's mean.
    """

    runs: Path
    free_bytes: int
    refusal: str
    utc: datetime
    installed: datetime
    tick_s: float
    synchronised: bool | None
    load: float
    processors: int


def read_computer(runs: Path, time_sync: Path = TIME_SYNC) -> Computer:
    """The readings; `runs` is the folder that run directories are made in, and is not made here."""
    folder = _existing(runs)
    refusal, free_bytes = "", 0
    try:
        free_bytes = shutil.disk_usage(folder).free
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        refusal = error.strerror or str(error)
    return Computer(
        runs=runs,
        free_bytes=free_bytes,
        refusal=refusal,
        utc=datetime.now(UTC),
        installed=datetime.fromtimestamp(Path(fieldnav.__file__).stat().st_mtime, UTC),
        tick_s=time.get_clock_info("monotonic").resolution,
        synchronised=(time_sync / SYNCHRONISED).exists() if time_sync.is_dir() else None,
        load=os.getloadavg()[0],
        processors=os.cpu_count() or 1,
    )


def _existing(folder: Path) -> Path:
    """The folder, or the nearest above it that there is: where it would be made."""
    return next((each for each in (folder, *folder.absolute().parents) if each.exists()), Path())
