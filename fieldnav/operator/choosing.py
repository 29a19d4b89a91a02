"""Which of the running missions an operator means."""

import os
from collections.abc import Sequence
from pathlib import Path

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import runs_in
from fieldnav.operator.socket_place import socket_path

NEWEST = "last"


def driven_in(sockets: Sequence[Path], runs: Path) -> list[Path]:
    """Those of the missions whose run directories lie in a folder, that made last first.

    Raises FieldnavError.
    """
    names = [run.path.name for run in runs_in(runs)]
    return [path for name in names for path in sockets if socket_path(path.parent, name) == path]


def choose(sockets: Sequence[Path], run: str | None) -> Path:
    """The mission meant: the only one, or the one whose run is named by its name, a part of it, or its path.

    `sockets` are of running missions, newest first. Raises FieldnavError unless exactly one is meant.
    """
    if not sockets:
        raise FieldnavError("no mission is running; allowed is a run that `fieldnav run` drives now")
    if run == NEWEST:
        return sockets[0]
    matching = list(sockets) if run is None else _named(sockets, run)
    if len(matching) == 1:
        return matching[0]
    names = ", ".join(path.stem for path in (matching or sockets))
    if matching:
        raise FieldnavError(f"several missions are running: {names}; name one with --run, or --run {NEWEST}")
    raise FieldnavError(f"no mission '{run}' is running; allowed is one of: {names}")


def _named(sockets: Sequence[Path], run: str) -> list[Path]:
    """The missions that a name stands for; a whole name goes before a part."""
    name = os.path.basename(os.path.abspath(run)) if os.sep in run else run
    exact = [path for path in sockets if name and path == socket_path(path.parent, name)]
    return exact or [path for path in sockets if name and name in path.stem]
