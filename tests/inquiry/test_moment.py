"""Moments of a run as people write them."""

import pytest

from fieldnav.errors import SettingsError
from fieldnav.inquiry.moment import Moment, clock, parse_moment, seconds_of


@pytest.mark.parametrize(
    ("text", "moment"),
    [
        ("17", Moment(seq=17)),
        ("41.3", Moment(at_s=41.3)),
        ("41s", Moment(at_s=41.0)),
        ("41.", Moment(at_s=41.0)),
        (".5", Moment(at_s=0.5)),
        ("1:23.4", Moment(at_s=83.4)),
        ("100:05", Moment(at_s=6005.0)),
        ("1:75", None),
        ("-3", None),
        ("1e3", None),
        ("last", None),
        ("", None),
    ],
)
def test_a_number_is_a_line_and_everything_else_a_time(text: str, moment: Moment | None) -> None:
    assert parse_moment(text) == moment


def test_an_option_that_is_no_time_says_what_is_allowed() -> None:
    with pytest.raises(SettingsError, match=r"--from: 'noon': allowed is a time of the run such as 41.3"):
        seconds_of("--from", "noon")


@pytest.mark.parametrize("seconds", [0.0, 41.26, 59.96, 3599.99, 6005.0])
def test_a_time_that_is_shown_can_be_asked_about(seconds: float) -> None:
    shown = parse_moment(clock(seconds))

    assert shown is not None and shown.at_s == pytest.approx(seconds, abs=0.0501)


def test_what_is_no_time_is_shown_as_such() -> None:
    assert clock(float("nan")) == "unknown"
