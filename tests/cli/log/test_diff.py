"""`fieldnav log diff`: what two runs did otherwise."""

import json
from collections.abc import Callable
from dataclasses import replace

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory

from .made_latched import LATCHED

Printed = Callable[[], str]
Made = Callable[..., RunDirectory]


def test_runs_that_are_alike_are_one_line(made: Made, printed: Printed) -> None:
    made("one")
    made("other")

    assert run(["log", "diff", "one", "other"]) == 0

    assert printed() == "the same 3 transitions in 20260501T083000Z-one and 20260501T083000Z-other\n"


def test_runs_that_differ_are_told_apart_by_transition_and_status(made: Made, printed: Printed) -> None:
    made("one")
    later = replace(LATCHED[2], stamp_s=21.8, forward_m=10.4)
    made("other", [*LATCHED[:2], later])

    assert run(["log", "diff", "one", "other"]) == 1
    text = printed()
    (moved,) = (line for line in text.splitlines() if " moved " in line and "lane ended" in line)
    assert "10.00 m, 0:21.0" in moved and "10.40 m, 0:21.8" in moved and "+0.40 m, +0.8 s" in moved
    assert text.splitlines()[-1] == "1 moved, 1 missing"

    assert run(["log", "diff", "one", "other", "--json"]) == 1
    assert [each["change"] for each in json.loads(printed())] == ["moved", "missing"]
