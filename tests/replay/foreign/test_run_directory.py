"""A foreign replay leaves a run's directory as any other run does."""

from typing import Any

import pytest

from fieldnav.inquiry.outcome import Outcome, overview
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import read
from fieldnav.journal.resolved import read_settings
from fieldnav.recording.recording import Recording


@pytest.fixture(scope="module")
def run(keeping: Any) -> tuple[RunDirectory, str]:
    """The directory, and what a person reads."""
    kept = keeping(lambda recordings: recordings.mcap(), as_json=False)
    return RunDirectory(kept.run), kept.said


def test_it_keeps_what_was_assumed_and_how_it_ended(run: tuple[RunDirectory, str]) -> None:
    directory, _ = run

    options = read_settings(directory.settings).options
    assert str(options["source"]).endswith("other.mcap") and options["front"] == "/front/image_raw"
    assert options["speed_mps"] == 0.5 and options["direction"] == "forward"
    assert overview(directory).outcome is Outcome.FINISHED


def test_its_recording_holds_the_pictures_that_were_judged(run: tuple[RunDirectory, str], drive: Any) -> None:
    directory, _ = run

    with Recording.open(directory) as recording:  # type: ignore[union-attr] # it has been written
        pictures = list(recording.pictures())
        judged = [step.frame for step in recording.steps() if step.frame is not None]

    given = {each.jpeg for each in drive.pictures}
    assert len(judged) > 100 and all(picture.jpeg in given for picture in pictures)


def test_its_stamps_are_those_of_the_recording(run: tuple[RunDirectory, str], drive: Any) -> None:
    directory, _ = run

    first = read(directory.journal)[0]

    assert first.utc.timestamp() == pytest.approx(drive.pictures[0].stamp_ns / 1e9, abs=0.001)


def test_a_person_reads_transitions_assumptions_and_how_well_rows_were_seen(
    run: tuple[RunDirectory, str],
) -> None:
    directory, said = run

    assert "assumed: forward at 0.5 m/s along the lane" in said
    assert "last lane left" in said and "probability that the lane has ended" in said
    assert "rows seen in" in said and "offset" in said and "heading" in said
    assert said.rstrip().endswith(f"run directory: {directory.path}")
