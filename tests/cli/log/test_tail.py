"""`fieldnav log tail` of a run that has ended."""

import json
from collections.abc import Callable

from fieldnav.cli.app import run
from fieldnav.journal.directory import RunDirectory

Printed = Callable[[], str]
Made = Callable[..., RunDirectory]


def test_the_tail_of_a_run_that_has_ended_is_its_last_lines(made: Made, printed: Printed) -> None:
    made()

    assert run(["log", "tail", "--last", "2"]) == 0

    ended, stopped, *_ = printed().splitlines()
    assert ended.split("  ")[-1] == "probability 0.52 > 0.5"
    assert stopped.endswith("latch  Forward.Exit -> Fault.Latched  bus off: gone")


def test_the_tail_for_programs_is_a_line_of_json_each(made: Made, printed: Printed) -> None:
    made()

    assert run(["log", "tail", "--json"]) == 0

    assert [json.loads(line)["seq"] for line in printed().splitlines()] == [0, 1, 2, 3]
