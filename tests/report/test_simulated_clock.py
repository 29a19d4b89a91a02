"""A simulated run began by a clock of its own; the report says so, and when it was really driven."""

import pytest

from fieldnav.journal.resolved import DRIVEN_UTC, write_settings
from fieldnav.report.writing import write_report
from fieldnav.settings.loading import load_crop, load_field, load_robot

DRIVEN = "2026-11-30T09:21:37+00:00"


def head_of(directory) -> str:
    return write_report(directory).read_text().partition('<div class="run">')[2].partition("</div>")[0]


@pytest.mark.parametrize(
    ("driven", "said"),
    [
        (DRIVEN, " by the simulated clock; really driven 2026-11-30 09:21:37 UTC"),
        (None, " by the simulated clock"),
        ("<b>noon</b>", " by the simulated clock"),
        ("0001-01-01T00:00:00+09:00", " by the simulated clock"),
    ],
)
def test_the_report_of_a_simulated_run_says_when_it_was_really_driven(driven, said, make_run) -> None:
    directory = make_run()
    robot, field = load_robot("bonnbot"), load_field("demo")
    options = {"lanes": 2, DRIVEN_UTC: driven}
    write_settings(directory.settings, load_crop("sugar-beet"), robot, field, options)

    assert head_of(directory).endswith(f" UTC{said}")


def test_the_report_of_a_robots_run_says_when_it_began(make_run) -> None:
    assert head_of(make_run()).endswith(" UTC") and "simulated" not in head_of(make_run(name="other"))
