"""`fieldnav log plot` and `log report` write what they say, where they say it."""

from pathlib import Path

import cv2
import pytest
from matplotlib.colors import to_hex

from fieldnav.cli.log.plot import plot
from fieldnav.cli.log.report import report
from fieldnav.errors import FieldnavError, OutputError, SettingsError
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.phases import PHASE_COLOURS
from fieldnav.messages import Evidence, Twist
from fieldnav.report.material import Problems, gather
from fieldnav.report.plot import WITHOUT_RECORDING, plot_of

from .made import EXIT, TRACKING, journalled

SEEN = (Evidence("offset from the lane", 0.031, None, "m"),)


@pytest.fixture
def run(tmp_path: Path) -> RunDirectory:
    """A run without a recording that stopped at 9 s; its name would be a formula to matplotlib."""
    entries = (
        Entry(0.0, "ready", "Checking", TRACKING, 1, 0, command=Twist(0.5)),
        Entry(5.0, "lane ended", TRACKING, EXIT, 1, 3, SEEN, command=Twist(0.5)),
        Entry(9.0, "fail", EXIT, "Fault.Recoverable", 1, 3, reason="bus off: gone"),
    )
    return journalled(tmp_path / "runs", "demo $\\frac$", entries)


def test_a_plot_lies_in_the_runs_directory(run: RunDirectory, capsys: pytest.CaptureFixture[str]) -> None:
    plot("last", run.path.parent)

    path = run.path / "plot.png"
    assert capsys.readouterr().out.splitlines() == [str(path), WITHOUT_RECORDING]
    assert cv2.imread(str(path)) is not None


def test_a_plot_of_another_kind_goes_where_it_is_told(run: RunDirectory, tmp_path: Path) -> None:
    out = tmp_path / "picture.SVG"

    plot("demo", run.path.parent, out)

    text = out.read_text()
    assert WITHOUT_RECORDING in text
    assert "lane 1" in text
    assert not (run.path / "plot.png").exists()


def test_the_same_run_gives_the_same_picture(run: RunDirectory, tmp_path: Path) -> None:
    pictures = [tmp_path / "first.svg", tmp_path / "second.svg"]

    for picture in pictures:
        plot("last", run.path.parent, picture)

    first, second = (picture.read_bytes() for picture in pictures)
    assert first == second


def test_a_plot_shows_the_states_the_values_and_the_stop(run: RunDirectory) -> None:
    strip, *panels = plot_of(gather(run, None, Problems())).axes

    phases = [to_hex(patch.get_facecolor()) for patch in strip.patches]
    assert phases == [PHASE_COLOURS[phase] for phase in ("Follow", "Exit", "Fault")]
    assert [panel.get_ylabel() for panel in panels] == ["offset, cm", "speed, m/s"]
    values = panels[0].lines[0]
    assert list(values.get_xdata()) == [5.0]
    assert list(values.get_ydata()) == pytest.approx([3.1])
    assert all(list(panel.lines[-1].get_xdata()) == [9.0, 9.0] for panel in panels)


def test_a_plot_of_an_unknown_kind_is_refused_before_anything_is_read(tmp_path: Path) -> None:
    with pytest.raises(
        SettingsError, match=r"--out: 'plot\.txt': allowed is a file that ends in \.png or \.svg"
    ):
        plot("last", tmp_path, Path("plot.txt"))


def test_a_plot_that_cannot_be_written_is_one_clear_line(run: RunDirectory, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written"):
        plot("last", run.path.parent, tmp_path / "no" / "folder" / "plot.png")


def test_a_journal_that_is_none_has_no_plot(run: RunDirectory) -> None:
    run.journal.write_text("no journal\n\n")

    with pytest.raises(FieldnavError, match="line 1 is not a line of a journal"):
        plot("last", run.path.parent)


def test_a_report_is_written_and_its_path_printed(
    run: RunDirectory, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report("last", run.path.parent)
    report("last", run.path.parent, tmp_path / "other.html")

    assert capsys.readouterr().out.splitlines() == [str(run.report), str(tmp_path / "other.html")]
    assert run.report.read_bytes() == (tmp_path / "other.html").read_bytes()
    assert "bus off: gone" in run.report.read_text()
