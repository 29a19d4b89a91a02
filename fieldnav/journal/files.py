"""Writing a whole file or none of it."""

import os
from pathlib import Path

from fieldnav.errors import OutputError


def write_atomically(path: Path, content: bytes) -> None:
    """Write beside the file, sync, rename over it. Raises OutputError; the old file then still stands."""
    beside = path.with_name(f".{path.name}.part")
    try:
        with beside.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(path)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        beside.unlink(missing_ok=True)
