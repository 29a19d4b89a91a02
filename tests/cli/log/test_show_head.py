"""`fieldnav log show`: a line of the journal in words, and what stands above them."""

from collections.abc import Callable
from pathlib import Path

import pytest
from rich.text import Text

from fieldnav.cli.app import run
from fieldnav.cli.log.tables import transitions_table
from fieldnav.journal.entry import Judged, Line

from .made import START, a_run

Printed = Callable[[], str]


def test_a_transition_is_told_with_the_figure_that_decided_it(runs: Path, printed: Printed) -> None:
    a_run(runs, "demo", completed=False)

    assert run(["log", "show", "last"]) == 0

    line = next(line for line in printed().splitlines() if "lane ended" in line)
    assert line.split()[:4] == ["1", "1:25.4", "Forward.Follow.Tracking", "Forward.Exit"]
    assert "no plant in the top half 0.53 > 0.4 s" in line
    assert "plants 41" not in line


def test_a_stopped_run_says_where_and_why_at_its_head(runs: Path, printed: Printed) -> None:
    a_run(runs, "demo", completed=False)

    assert run(["log", "show"]) == 0

    first, second = printed().splitlines()[:2]
    assert first == "20260501T083000Z-demo  stopped  lanes 1/3, switches 0/0, 12.6 m in 1:30.0"
    assert second == "Fault.Recoverable: rear camera silent"


def test_the_reason_stands_before_the_evidence_and_stands_out() -> None:
    held = Judged(name="coasted", value=2.1, threshold=2.0, unit="m")
    line = Line(
        seq=0, stamp_s=1, utc=START, event="fail", source="A", target="B", evidence=(held,), reason="lost"
    )

    (because,) = transitions_table([line]).columns[-1].cells

    assert isinstance(because, Text)
    assert because.plain == "lost\ncoasted 2.1 > 2 m"
    assert [(span.start, span.end, span.style) for span in because.spans] == [(0, len("lost"), "bold")]


@pytest.mark.parametrize("number", ["1e400", "-1e400"])
def test_a_journal_with_a_number_beyond_all_numbers_is_one_line(
    number: str, runs: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    journal = a_run(runs, "demo", completed=False).journal
    journal.write_text(journal.read_text().replace("85.43", number))

    assert run(["log", "show"]) == 2
    assert "journal.jsonl: line 2 is not a line of a journal" in capsys.readouterr().err
