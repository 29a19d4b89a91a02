"""A replay repeats an unchanged run bit for bit, and tells exactly what a change moves."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from fieldnav.errors import FieldnavError
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import read
from fieldnav.journal.resolved import Settings, read_settings
from fieldnav.recording.piece import Piece, new_file
from fieldnav.recording.piece_names import piece_path
from fieldnav.replay.difference import Kind
from fieldnav.replay.replay import replay


def with_headland(settings: Settings, more_m: float) -> Settings:
    switching = settings.crop.switching
    wider = switching.model_copy(update={"headland_m": switching.headland_m + more_m})
    return replace(settings, crop=settings.crop.model_copy(update={"switching": wider}))


# A sidestep is replayed in tests/replay/test_golden.py, too.
@pytest.mark.parametrize(
    ("run", "more_than"), [("recorded", 4), pytest.param("two_lanes", 10, marks=pytest.mark.long)]
)
def test_an_unchanged_run_is_repeated_bit_for_bit(
    run: str, more_than: int, request: pytest.FixtureRequest
) -> None:
    directory: RunDirectory = request.getfixturevalue(run)

    done = replay(directory, read_settings(directory.settings))

    assert done.same, done
    assert done.transitions == len(read(directory.journal)) > more_than


def test_leaving_the_lane_earlier_moves_that_alone_where_nothing_follows(recorded: RunDirectory) -> None:
    then = read_settings(recorded.settings)

    done = replay(recorded, then, with_headland(then, -0.1))

    (left,) = done.differences
    assert (left.line.event, left.kind) == ("last lane left", Kind.MOVED)
    assert left.later_m == pytest.approx(-0.1, abs=0.08)
    assert done.commands.first_s < left.then.stamp_s


@pytest.mark.long  # one lane in the test before
def test_leaving_the_lane_earlier_moves_that_and_what_follows_of_it(two_lanes: RunDirectory) -> None:
    then = read_settings(two_lanes.settings)

    done = replay(two_lanes, then, with_headland(then, -0.1))

    left = [each for each in done.differences if "left" in each.line.event]
    assert [each.line.event for each in left] == ["lane left", "last lane left"]
    for each in left:
        assert each.kind is Kind.MOVED
        assert each.later_m == pytest.approx(-0.1, abs=0.08)
    rest = [each for each in done.differences if each not in left]
    assert all("Sidestep" in each.line.source for each in rest), "where it begins 0.1 m earlier"
    assert done.commands.first_s < left[0].then.stamp_s


def test_leaving_the_lane_later_than_the_robot_drove_is_said_to_lack_that_much(
    recorded: RunDirectory,
) -> None:
    then = read_settings(recorded.settings)

    done = replay(recorded, then, with_headland(then, 0.1))

    left = [each for each in done.differences if "left" in each.line.event]
    assert [each.kind for each in left] == [Kind.MISSING]
    assert "to the place to stop" in left[0].said


def test_a_transition_that_the_journal_has_otherwise_is_found(recorded: RunDirectory, tmp_path: Path) -> None:
    copy = RunDirectory(shutil.copytree(recorded.path, tmp_path / "run"))
    lines = copy.journal.read_text().splitlines()
    changed = [
        line.replace('"lane ended"', '"rows lost"') if "lane ended" in line else line for line in lines
    ]
    copy.journal.write_text("\n".join(changed) + "\n")

    done = replay(copy, read_settings(copy.settings))

    assert {each.line.event for each in done.differences} >= {"rows lost", "lane ended"}


def test_what_the_journal_judged_otherwise_is_found(recorded: RunDirectory, tmp_path: Path) -> None:
    copy = RunDirectory(shutil.copytree(recorded.path, tmp_path / "run"))
    text = copy.journal.read_text()
    quantity, condition = '"probability that the lane has ended", "value": ', '"fires": "last lane left"'
    assert quantity in text and condition in text
    text = text.replace(quantity, f"{quantity}1", 1).replace(condition, '"fires": "rows lost"', 1)
    copy.journal.write_text(text)

    done = replay(copy, read_settings(copy.settings))

    assert [each.kind for each in done.differences] == [Kind.JUDGED, Kind.JUDGED]
    assert "probability that the lane has ended" in done.differences[0].said
    assert "fires rows lost -> last lane left" in done.differences[1].said


def test_a_recording_that_broke_off_is_replayed_as_far_as_it_goes(
    recorded: RunDirectory, tmp_path: Path
) -> None:
    copy = RunDirectory(shutil.copytree(recorded.path, tmp_path / "run"))
    content = copy.recording.read_bytes()
    copy.recording.write_bytes(content[: len(content) // 2])

    done = replay(copy, read_settings(copy.settings))

    assert not done.differences
    assert not done.commands.rounds
    assert "lines of the journal, the first at" in done.incomplete[0]
    assert not done.same


def test_a_flipped_byte_in_what_is_not_compared_is_told_all_the_same(
    recorded: RunDirectory, tmp_path: Path
) -> None:
    copy = RunDirectory(shutil.copytree(recorded.path, tmp_path / "run"))
    content = bytearray(copy.recording.read_bytes())
    content[content.index(b"Follow.Tracking")] ^= 1
    copy.recording.write_bytes(content)

    with pytest.raises(FieldnavError, match=r"recording\.mcap: is damaged: the chunk at byte \d+"):
        replay(copy, read_settings(copy.settings))


def test_a_file_of_the_recording_that_lacks_is_named(recorded: RunDirectory, tmp_path: Path) -> None:
    copy = RunDirectory(shutil.copytree(recorded.path, tmp_path / "run"))
    Piece(piece_path(copy, 3), read(copy.journal)[0].utc, new_file).close()

    done = replay(copy, read_settings(copy.settings))

    assert done.incomplete == ("recording-0002.mcap is not there",) and not done.same


def test_a_run_without_recording_says_so(recorded: RunDirectory, tmp_path: Path) -> None:
    copy = RunDirectory(shutil.copytree(recorded.path, tmp_path / "run"))
    copy.recording.unlink()

    with pytest.raises(
        FieldnavError, match=r"recording.mcap: is not there; allowed is a run that was recorded"
    ):
        replay(copy, read_settings(copy.settings))
