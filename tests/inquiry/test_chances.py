"""What could have come of a judgement, and how near it was."""

from math import inf

import pytest

from fieldnav.inquiry.chances import chances, deciding, lacking_share
from fieldnav.journal.entry import Judged
from fieldnav.messages import Bound

ENDED = Judged(name="probability", value=0.45, threshold=0.5, fires="lane ended")
UNSEEN = Judged(name="unseen over", value=0.3, threshold=0.25, unit="m", fires="rows lost", bound=Bound.ABOVE)
SEEN = Judged(name="rows seen", value=3, threshold=1.5, fires="rows lost", bound=Bound.BELOW)
COASTED = Judged(
    name="coasted", value=2.6, threshold=2.5, unit="m", fires="fail", bound=Bound.ABOVE, alone=True
)
UNSURE = Judged(
    name="uncertain by", value=0.04, threshold=0.08, unit="m", fires="fail", bound=Bound.ABOVE, alone=True
)
PLAIN = Judged(name="offset", value=0.01, unit="m")


def test_the_events_of_a_judgement_come_nearest_first() -> None:
    assert [chance.event for chance in chances([SEEN, UNSEEN, PLAIN, ENDED, COASTED])] == [
        "fail",
        "lane ended",
        "rows lost",
    ]


def test_an_event_holds_with_all_its_conditions_or_with_one_that_is_alone() -> None:
    holds = {chance.event: chance.holds for chance in chances([UNSEEN, SEEN, COASTED, UNSURE])}

    assert holds == {"rows lost": False, "fail": True}


def test_an_event_that_lacks_something_lacks_its_worst_condition() -> None:
    (chance,) = chances([UNSEEN, SEEN])

    assert chance.deciding == (SEEN,)
    assert chance.lacking == 1.0  # a row and a half beyond one and a half


def test_of_conditions_that_are_enough_alone_the_nearest_counts() -> None:
    near = COASTED.model_copy(update={"value": 2.0})

    (chance,) = chances([near, UNSURE])

    assert chance.deciding == (near,)
    assert chance.lacking == pytest.approx(0.2)


def test_an_event_that_came_about_was_decided_by_what_held() -> None:
    assert deciding("fail", [UNSEEN, COASTED, UNSURE, PLAIN]) == (COASTED,)
    assert deciding("rows lost", [UNSEEN, SEEN.model_copy(update={"value": 1})]) == (
        UNSEEN,
        SEEN.model_copy(update={"value": 1}),
    )


def test_an_event_that_no_quantity_is_a_condition_of_was_decided_by_none() -> None:
    assert deciding("pause", [UNSEEN, PLAIN]) == ()


def test_in_an_older_journal_everything_with_a_threshold_decided() -> None:
    older = [Judged(name="frames", value=4, threshold=4), PLAIN]

    assert deciding("rows found", older) == (older[0],)


def test_what_is_unknown_lacks_everything_and_a_threshold_of_zero_is_met_in_its_unit() -> None:
    assert lacking_share(ENDED.model_copy(update={"value": None})) == inf
    assert lacking_share(ENDED.model_copy(update={"value": -0.2, "threshold": 0.0})) == pytest.approx(0.2)
    assert lacking_share(UNSEEN) == 0.0
