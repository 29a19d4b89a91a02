"""A run that is refused before it has begun leaves no directory behind."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager

from fieldnav.journal.directory import RunDirectory


@contextmanager
def removed_if_refused(directory: RunDirectory) -> Iterator[None]:
    """Remove the directory where an error comes before the journal has its first line."""
    try:
        yield
    except BaseException:
        if not begun(directory):
            shutil.rmtree(directory.path, ignore_errors=True)
        raise


def begun(directory: RunDirectory) -> bool:
    """Whether the journal has a line, so that there is something to be known of the run."""
    try:
        return directory.journal.stat().st_size > 0
    except OSError:
        return False
