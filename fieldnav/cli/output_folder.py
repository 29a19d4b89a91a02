"""Files and folders that a command writes: named, and tried before it begins its work."""

import tempfile
from pathlib import Path

import typer

from fieldnav.errors import OutputError


def output_path(text: str | Path) -> Path:
    """The path that an option names; Path alone takes an empty name for the folder one is in."""
    if not str(text):
        raise typer.BadParameter("'' is not allowed; allowed is the name of a file or a folder")
    return Path(text)


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
