"""What is said of a run that ended without a stop."""

from collections.abc import Callable, Sequence

from fieldnav.inquiry.asked import asked_about
from fieldnav.inquiry.headline import Kind, headline
from fieldnav.inquiry.moment import Moment
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.ledger import Booking, Ledger

Written = Callable[..., RunDirectory]
BOOKING = Booking(
    stamp_s=27.5, state="x", side="right", lanes=1, lane=1, done=(), rows=3, forward_m=1.0, sideways_m=0.0
)


def test_a_run_that_broke_off_did_so_where_its_ledger_ends(
    written: Written, mission: Sequence[Entry]
) -> None:
    directory = written(mission[:6])
    with Ledger(directory.ledger) as ledger:
        ledger.book(BOOKING)

    for moment in (None, Moment(at_s=29.0)):
        said = headline(asked_about(directory, moment))

        assert said.kind is Kind.BROKE_OFF
        assert said.text.startswith(
            "broke off at 0:27.5 in lane 1, in Forward.Follow.Coasting: process killed: "
        )


def test_before_a_run_broke_off_it_was_still_in_its_state(written: Written, mission: Sequence[Entry]) -> None:
    directory = written(mission[:6])
    with Ledger(directory.ledger) as ledger:
        ledger.book(BOOKING)

    assert headline(asked_about(directory, Moment(at_s=26.5))).kind is Kind.NOTHING


def test_a_run_that_is_being_driven_has_not_broken_off(written: Written, mission: Sequence[Entry]) -> None:
    directory = written(mission[:6])

    with Ledger(directory.ledger) as ledger:
        ledger.book(BOOKING)
        said = headline(asked_about(directory, None))

    assert said.kind is Kind.CHANGED
