"""The pictures of `bench switching`: every switch as a track, and how the new lanes were entered."""

from collections.abc import Sequence
from pathlib import Path

from fieldnav.evaluation.campaign_drawing import save
from fieldnav.evaluation.switching_entries import entry_picture
from fieldnav.evaluation.switching_runs import Switched
from fieldnav.evaluation.switching_tracks import tracks_picture

TRACKS, ENTRIES = "switches.png", "entries.png"


def draw_switching(folder: Path, runs: Sequence[Switched]) -> None:
    """Draw both into a folder that exists; nothing where no switch was begun. Raises OutputError."""
    if not any(run.switches for run in runs):
        return
    save(tracks_picture(runs), folder / TRACKS)
    save(entry_picture(runs), folder / ENTRIES)
