"""`fieldnav log stats`: sums, margins, and what nearly came about."""

import json
from collections.abc import Callable

import pytest

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory

from .made import EXIT, TRACKING, record
from .made_latched import nearly_lost

Printed = Callable[[], str]
Made = Callable[..., RunDirectory]


def test_stats_add_up_time_way_margins_faults_and_lateness(made: Made, printed: Printed) -> None:
    made()

    assert run(["log", "stats"]) == 0

    text = printed()
    (tracking,) = (line.split() for line in text.splitlines() if line.startswith(TRACKING))
    assert tracking == [TRACKING, "0:20.0", "88.9%", "10.0", "m", "1", "20.0", "s"]
    (ended,) = (line.split() for line in text.splitlines() if line.startswith("lane ended"))
    assert ended == ["lane", "ended", "probability", "1", "0.02", "0.02", "0.02"]
    assert ["bus", "off", "1", "0"] in [line.split() for line in text.splitlines()]
    assert ["camera", "black", "0", "1"] in [line.split() for line in text.splitlines()]
    assert "near misses are not known: this run has no recording" in text
    assert "lateness of the loop: 99 % within 2.5 ms, at most 9.5 ms, 1175 rounds" in text


def test_stats_name_what_nearly_came_about(made: Made, printed: Printed) -> None:
    record(made(), nearly_lost())

    assert run(["log", "stats", "--json"]) == 0

    told = json.loads(printed())
    (missed,) = told["near_misses"]
    assert (missed["at_s"], missed["event"], missed["by"]) == (5.0, "rows lost", ["rows seen"])
    assert missed["lacking_share"] == pytest.approx(0.1 / 1.5)
    assert told["states"][EXIT]["seconds"] == 2.5
    assert told["lanes"]["1"] == {"transitions": 3, "coastings": 0, "holds": 1, "stops": 1}
    assert told["stops"] == {"bus off": 1}


def test_a_near_miss_is_a_row_with_what_it_lacked_and_by_which_condition(
    made: Made, printed: Printed
) -> None:
    record(made(), nearly_lost())

    assert run(["log", "stats"]) == 0

    below = printed().partition("nearly came about, and did not")[2].splitlines()
    assert below[2].split() == [
        "0:05.0",
        "1",
        "rows",
        "lost",
        "6.7%",
        "rows",
        "seen",
        "1.6",
        ">",
        "1.5",
        "rows",
    ]
    assert below[3].split() == ["in", TRACKING]


def test_a_count_that_had_just_been_reached_has_no_row_among_the_margins(
    made: Made, printed: Printed
) -> None:
    made()

    assert run(["log", "stats"]) == 0

    text = printed()
    assert "frames that agree" not in text
    assert "1 condition without a margin: a count that had just been reached" in text
