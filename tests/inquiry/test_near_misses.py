"""What nearly came about is told from what came about, and from what was never near."""

import pytest

from fieldnav.inquiry.near_misses import NearMiss, NearMisses
from fieldnav.journal.entry import Judged
from fieldnav.messages import Bound
from fieldnav.recording.records import Stepped


def condition(event: str, value: float, threshold: float = 1.0, alone: bool = False) -> Judged:
    return Judged(name="what", value=value, threshold=threshold, fires=event, bound=Bound.ABOVE, alone=alone)


def step(now_s: float, *evidence: Judged, event: str = "", state: str = "Exit", lane: int = 1) -> Stepped:
    return Stepped(now_s=now_s, state=state, lane=lane, forward_m=0.0, event=event, evidence=evidence)


def found(*steps: Stepped, most: int = 10) -> list[NearMiss]:
    misses = NearMisses()
    for each in steps:
        misses.add(each)
    return misses.closest(most)


def approach(begin_s: float, event: str, peak: float) -> list[Stepped]:
    """Up to the peak and away again."""
    values = (0.1, peak - 0.05, peak, peak - 0.05, 0.1)
    return [step(begin_s + index, condition(event, value)) for index, value in enumerate(values)]


def test_an_approach_that_draws_away_is_found_at_its_closest() -> None:
    (miss,) = found(*approach(0.0, "rows lost", 0.95))

    assert miss.step.now_s == 2.0
    assert miss.lacking == pytest.approx(0.05)


def test_an_approach_that_ends_in_its_event_is_none() -> None:
    assert not found(
        step(0.0, condition("rows lost", 0.9)),
        step(1.0, condition("rows lost", 1.1), event="rows lost"),
        step(2.0, condition("rows lost", 0.1), state="Coasting"),
    )


def test_an_event_that_comes_soon_after_all_was_not_missed() -> None:
    assert not found(
        *approach(0.0, "rows lost", 0.95), step(6.0, condition("rows lost", 1.1), event="rows lost")
    )


def test_an_event_that_comes_much_later_was_missed_before() -> None:
    later = step(30.0, condition("rows lost", 1.1), event="rows lost")

    (miss,) = found(*approach(0.0, "rows lost", 0.95), later)

    assert miss.step.now_s == 2.0


def test_an_approach_that_another_event_cuts_short_is_a_near_miss() -> None:
    (miss,) = found(
        step(0.0, condition("fail", 0.9), condition("lane reached", 0.5)),
        step(1.0, condition("fail", 0.95), condition("lane reached", 1.5), event="lane reached"),
        step(2.0, state="Verifying"),
    )

    assert miss.chance.event == "fail"
    assert miss.step.now_s == 1.0


def test_what_holds_and_gives_way_to_another_event_is_no_near_miss() -> None:
    assert not found(step(0.0, condition("rows lost", 1.2)), step(1.0, condition("rows lost", 0.1)))


def test_the_farthest_of_several_conditions_decides_how_near_it_was() -> None:
    assert not found(step(0.0, condition("rows lost", 0.99), condition("rows lost", 0.1)))


def test_a_condition_that_is_enough_alone_counts_alone() -> None:
    (miss,) = found(step(0.0, condition("fail", 0.9, alone=True), condition("fail", 0.1)))

    assert miss.lacking == pytest.approx(0.1)


def test_a_threshold_of_nothing_has_no_nearness() -> None:
    assert not found(step(0.0, condition("fail", 0.0, threshold=0.0)))


def test_the_closest_come_first_and_no_event_more_than_twice() -> None:
    peaks = {"rows lost": (0.85, 0.95, 0.9), "fail": (0.92,)}
    steps = [
        each
        for event, values in peaks.items()
        for index, peak in enumerate(values)
        for each in approach(100.0 * index, event, peak)
    ]

    misses = found(*steps)

    assert [(miss.chance.event, round(miss.lacking, 2)) for miss in misses] == [
        ("rows lost", 0.05),
        ("fail", 0.08),
        ("rows lost", 0.1),
    ]
    assert len(found(*steps, most=1)) == 1


def test_another_lane_begins_anew() -> None:
    misses = found(step(0.0, condition("rows lost", 0.9)), step(1.0, condition("rows lost", 0.95), lane=2))

    assert [miss.step.lane for miss in misses] == [2, 1]
