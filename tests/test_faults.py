"""The table of faults: complete, and what the documentation prints of it."""

from pathlib import Path

from fieldnav.faults import FAULTS, FaultKind, Reaction, Trouble
from fieldnav.mission.loop import EVENTS
from fieldnav.perception.second_witness import NO_FIELD

PAGE = Path(__file__).parent.parent / "docs" / "faults.md"


def test_every_fault_has_a_reaction_a_sign_and_advice() -> None:
    assert set(FAULTS) == set(FaultKind)
    for declared in FAULTS.values():
        assert declared.noticed and declared.advice


def test_every_reaction_that_stops_is_an_event_of_the_machine() -> None:
    assert set(EVENTS) == set(Reaction) - {Reaction.CONTINUE, Reaction.SLOW, Reaction.MODULES_STOP}


def test_the_journal_calls_a_fault_by_its_name() -> None:
    assert str(Trouble(FaultKind.CAMERA_BLACK, "front camera")) == "camera black: front camera"


def test_the_documentation_prints_the_table_that_the_code_runs_from() -> None:
    page = PAGE.read_text(encoding="utf-8")

    for kind, declared in FAULTS.items():
        row = f"| {kind.value} | {declared.reaction.value} | {declared.noticed} | {declared.advice} |"
        assert row in page, row


def test_the_documentation_gives_the_reason_of_a_stop_without_a_field() -> None:
    assert NO_FIELD in " ".join(PAGE.read_text(encoding="utf-8").split())
