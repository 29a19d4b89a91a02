"""`fieldnav diagram` prints what the state machine's package draws."""

import pytest

from fieldnav.cli.app import run
from states.diagram import mermaid, svg


def test_mermaid_is_printed_unless_told_otherwise(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram"]) == 0
    assert capsys.readouterr().out == mermaid() + "\n"


def test_the_picture_is_printed_when_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram", "--format", "svg"]) == 0
    assert capsys.readouterr().out == svg() + "\n"


def test_an_unknown_format_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram", "--format", "png"]) == 2
    assert "'png' is not one of 'mermaid', 'svg'" in capsys.readouterr().err
