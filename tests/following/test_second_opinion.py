"""Rows that vegetation shows and the network does not see: slower, then a stop that says so."""

from types import SimpleNamespace

import pytest

from fieldnav.perception import perceive
from fieldnav.perception.second_witness import NO_FIELD, by_vegetation_alone
from fieldnav.settings.crop import ControlLaw
from states import tracking
from states.names import Event

UNSEEN = 0.1
"""Share that is borne out by a network that hardly sees any rows."""


def follower(drawn: SimpleNamespace, second_witness: bool = True) -> SimpleNamespace:
    crop = drawn.profile(ControlLaw.PATH_FOLLOWING)
    driven = crop if second_witness else by_vegetation_alone(crop)
    return drawn.robot(driven, drawn.lane(crop, (14.0,) * 3))


@pytest.fixture
def blind(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """The network sees no rows from the moment that this is asked to `start`."""

    def start() -> None:
        for module in (perceive, tracking):
            monkeypatch.setattr(module, "share_borne_out", lambda *_: UNSEEN)

    return SimpleNamespace(start=start)


def test_rows_that_the_network_does_not_see_are_lost_after_a_metre_and_the_robot_stops(
    drawn: SimpleNamespace, blind: SimpleNamespace
) -> None:
    robot = follower(drawn)
    robot.drive("tracking", 2.0)
    blind.start()

    step = robot.follow(to_m=10.0)

    lost_m = next(s_m for s_m, _, each in robot.passed if each.event is Event.ROWS_LOST)
    assert 3.0 < lost_m < 3.4
    assert robot.went_through() == ["tracking", "coasting"]
    assert (step.event, step.reason) == (Event.FAIL, NO_FIELD)
    assert robot.s_m < lost_m + robot.task.crop.row_end.longest_gap_m + 0.1
    assert step.motion.twist.vx_mps == 0


def test_without_the_second_witness_vegetation_alone_is_followed(
    drawn: SimpleNamespace, blind: SimpleNamespace
) -> None:
    robot = follower(drawn, second_witness=False)
    blind.start()

    step = robot.drive("tracking", 6.0)

    assert step.event is None and robot.s_m >= 6.0


def test_the_network_bears_out_the_rows_that_are_followed(drawn: SimpleNamespace) -> None:
    robot = follower(drawn)
    doubted = []

    robot.drive("tracking", 8.0, lambda step: doubted.extend(each for each in step.evidence))

    over = [each.value for each in doubted if each.name == "rows not borne out by the network over"]
    assert len(over) > 50 and max(over) < 0.3
