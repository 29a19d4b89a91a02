"""Writing a run's report.html from what lies in its directory."""

from contextlib import nullcontext
from pathlib import Path

from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.files import check_replaceable, write_atomically
from fieldnav.journal.resolved import skies_px
from fieldnav.report.composing import compose
from fieldnav.report.material import Problems, gather, open_recording
from fieldnav.report.page import render
from fieldnav.report.pictures import Pictures


def write_report(directory: RunDirectory, out: Path | None = None) -> Path:
    """Write report.html, or `out`, whatever can be read of the run; returns its path. Raises OutputError."""
    path = out or directory.report
    check_replaceable(path)
    problems = Problems()
    with open_recording(directory, problems) or nullcontext() as recording:
        material = gather(directory, recording, problems)
        page = compose(material, Pictures(recording, skies_px(directory.settings)))
    write_atomically(path, render(page).encode(errors="replace"))
    return path
