"""A recording's ticks as a table in a file or on standard output."""

from collections.abc import Iterator
from pathlib import Path

from fieldnav.cli.log.export_csv import write_csv
from fieldnav.errors import FieldnavError
from fieldnav.inquiry.flat import Cell
from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import Wheel
from fieldnav.recording.recording import Recording
from fieldnav.recording.records import Module, Ticked

OF_A_TICK = [name for name in Ticked.model_fields if name != "modules"]
OF_A_MODULE = list(Module.model_fields)


def ticks_csv(directory: RunDirectory, target: Path | None) -> None:
    """One row a tick. Raises FieldnavError for a run that has no recording."""
    recording = Recording.open(directory)
    if recording is None:
        raise FieldnavError(f"--ticks: {directory.path} has no recording; allowed is to leave it out")
    names = [*OF_A_TICK, *(f"{wheel.value}_{name}" for wheel in Wheel for name in OF_A_MODULE)]
    with recording:
        write_csv(target, names, _rows(recording))


def _rows(recording: Recording) -> Iterator[dict[str, Cell]]:
    for tick in recording.ticks():
        row: dict[str, Cell] = {name: getattr(tick, name) for name in OF_A_TICK}
        for wheel, module in tick.modules.items():
            row |= {f"{wheel.value}_{name}": getattr(module, name) for name in OF_A_MODULE}
        yield row
