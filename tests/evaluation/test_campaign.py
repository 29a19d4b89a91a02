"""Campaigns: outcomes in order, failures that stay where they are, an end that leaves no process behind."""

import os
import time
from collections.abc import Callable
from functools import partial
from math import sqrt
from multiprocessing import active_children
from operator import call

import pytest

from fieldnav.evaluation.campaign import Failed, run_campaign

Job = Callable[[], object]


def untold(part: str, done: int, steps: int) -> None:
    """Nobody watches."""


def test_outcomes_come_in_the_jobs_order_and_an_error_is_one_of_them() -> None:
    jobs: list[Job] = [partial(sqrt, 4), partial(sqrt, -1), partial(sqrt, 9)]

    outcomes = run_campaign("roots", call, jobs, 2, untold)

    assert outcomes[0] == 2 and outcomes[2] == 3
    assert isinstance(outcomes[1], Failed) and outcomes[1].job is jobs[1]
    assert "math domain error" in outcomes[1].reason


def test_a_process_that_dies_costs_its_own_job_alone() -> None:
    jobs: list[Job] = [partial(os._exit, 1), partial(sqrt, 4), partial(sqrt, 9)]
    told: list[tuple[int, int]] = []

    outcomes = run_campaign("roots", call, jobs, 1, lambda part, done, steps: told.append((done, steps)))

    assert outcomes[1:] == [2, 3]
    assert outcomes[0] == Failed(jobs[0], "its process died", died=True)
    assert told[0] == (0, 3) and told[-1] == (3, 3)


def test_an_interruption_ends_every_process_at_once() -> None:
    jobs: list[Job] = [partial(sqrt, 4), partial(time.sleep, 600)]
    others = set(active_children())

    def interrupt(part: str, done: int, steps: int) -> None:
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_campaign("roots", call, jobs, 2, interrupt)

    assert set(active_children()) <= others


def test_no_jobs_have_no_outcomes() -> None:
    assert run_campaign("roots", call, [], 2, untold) == []
