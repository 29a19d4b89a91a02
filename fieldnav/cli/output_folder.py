"""Folders that a command writes into, made and tried before it begins its work."""

import tempfile
from pathlib import Path

from fieldnav.errors import OutputError


def make_writable(folder: Path, label: str) -> None:
    """Make the folder if it lacks, and try to write there. Raises OutputError, beginning with the label."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise OutputError(
            f"{label} cannot be written here: {error.strerror}; allowed is a folder you can write"
        ) from error
