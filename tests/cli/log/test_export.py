"""`fieldnav log export`: a run as a table or as one MCAP file."""

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path

import pytest
from mcap.reader import make_reader

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import read
from fieldnav.recording.message import Topic
from fieldnav.recording.recording import Recording

from .made import record
from .made_latched import nearly_lost

Printed = Callable[[], str]
Made = Callable[..., RunDirectory]


def test_a_table_has_a_row_a_line_and_a_column_a_quantity(made: Made, printed: Printed) -> None:
    made()

    assert run(["log", "export", "--csv", "-"]) == 0

    table = list(csv.DictReader(io.StringIO(printed())))
    assert [row["event"] for row in table] == ["rows found", "held by the gate", "lane ended", "latch"]
    ended = table[2]
    assert (ended["probability"], ended["probability: threshold"], ended["probability: margin"]) == (
        "0.52",
        "0.5",
        "0.02",
    )
    assert (ended["forward_m"], ended["utc"]) == ("10.0", "2026-05-01T08:30:21.000Z")
    assert table[3]["reason"] == "bus off: gone" and table[3]["probability"] == ""


def test_a_table_of_ticks_has_a_row_a_tick_and_the_wheels_in_it(made: Made, printed: Printed) -> None:
    record(made(), nearly_lost())

    assert run(["log", "export", "--csv", "ticks.csv", "--ticks"]) == 0
    assert printed() == "ticks.csv\n"

    table = list(csv.DictReader(io.StringIO(Path("ticks.csv").read_text())))
    assert [row["now_s"] for row in table] == ["4.0", "5.0", "6.0"]
    assert (table[0]["front_left_speed_mps"], table[0]["rear_left_speed_mps"]) == ("0.49", "")


def test_a_recording_in_pieces_becomes_one_file_that_says_the_same(made: Made, printed: Printed) -> None:
    directory = made()
    for _ in range(2):  # a run that is resumed goes on in a piece of its own
        record(directory, nearly_lost())

    assert run(["log", "export", "--mcap", "whole.mcap"]) == 0
    assert printed() == "whole.mcap\n"

    copied = RunDirectory(Path("copy"))
    copied.path.mkdir()
    Path("whole.mcap").rename(copied.recording)
    with Recording.open(copied) as whole, Recording.open(directory) as pieces:  # type: ignore[union-attr]
        assert list(whole.steps()) == list(pieces.steps()) != []
        assert list(whole.ticks()) == list(pieces.ticks())


def test_without_a_recording_the_file_holds_the_journal(made: Made) -> None:
    directory = made()

    assert run(["log", "export", "--mcap", "journal.mcap"]) == 0

    with Path("journal.mcap").open("rb") as file:
        messages = [(channel.topic, message) for _, channel, message in make_reader(file).iter_messages()]
    assert {topic for topic, _ in messages} == {Topic.TRANSITION.value}
    assert [json.loads(message.data)["seq"] for _, message in messages] == [0, 1, 2, 3]
    first = read(directory.journal)[0]
    assert messages[0][1].log_time == round(first.utc.timestamp() * 1e9)


@pytest.mark.parametrize("option", ["--csv", "--mcap"])
def test_a_file_that_exists_is_kept_unless_it_may_be_lost(
    option: str, made: Made, capsys: pytest.CaptureFixture[str]
) -> None:
    made()
    Path("mine").write_text("precious")

    assert run(["log", "export", option, "mine"]) == 2
    assert Path("mine").read_text() == "precious"
    assert f"{option}: mine: exists; allowed is another name, or --force" in capsys.readouterr().err

    assert run(["log", "export", option, "mine", "--force"]) == 0
    assert Path("mine").read_bytes() != b"precious"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "allowed is either --csv FILE or --mcap FILE"),
        (["--csv", "a", "--mcap", "b"], "allowed is either --csv FILE or --mcap FILE"),
        (["--mcap", "b", "--ticks"], "--ticks: allowed with --csv only"),
        (["--csv", "-", "--ticks"], "has no recording; allowed is to leave it out"),
        (["--mcap", "-"], "--mcap: '-': allowed is the name of a file"),
        (["--csv", "runs"], "--csv: runs: is a folder; allowed is the name of a file"),
        (["--csv", "nowhere/a"], "nowhere/a: cannot be written: No such file or directory"),
        (["--mcap", "nowhere/a"], "nowhere/a: cannot be written: No such file or directory"),
    ],
)
def test_what_cannot_be_exported_is_one_line(
    options: list[str], said: str, made: Made, capsys: pytest.CaptureFixture[str]
) -> None:
    made()

    assert run(["log", "export", *options]) == 2

    captured = capsys.readouterr()
    assert captured.out == "" and said in captured.err
    assert [path.name for path in Path().iterdir()] == ["runs"]
