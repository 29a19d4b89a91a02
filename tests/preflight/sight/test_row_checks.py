"""The crop profile against the rows that a camera sees."""

import pytest

from fieldnav.perception import perceive
from fieldnav.perception.second_witness import NO_FIELD
from fieldnav.preflight.finding import Verdict
from fieldnav.settings.loading import load_crop

WIDE = (0.275, -0.275)
"""Places of rows in the paper's wide pattern, in m."""


def test_rows_and_canopy_as_in_the_profile_are_told_with_both_numbers(bench):
    found = bench.check(bench.crop)

    rows, canopy = found["front camera rows"], found["front camera canopy"]
    assert rows.verdict is canopy.verdict is Verdict.OK
    assert rows.figure.endswith("0.35 m in the profile; 3 of the lane's 3 rows under the robot")
    assert float(rows.figure.split()[2]) == pytest.approx(0.35, abs=0.02)
    assert float(canopy.figure.split()[0]) == pytest.approx(0.2, abs=0.04)


def test_rows_closer_than_in_the_profile_fail_with_both_distances(bench):
    found = bench.check(load_crop("beans"))

    rows = found["front camera rows"]
    assert rows.verdict is Verdict.FAIL
    assert "0.55 m in the profile" in rows.figure
    assert float(rows.figure.split()[2]) < 0.4
    assert "name the crop that grows here" in rows.advice
    assert "front camera canopy" not in found, "it is of another crop"


def test_rows_further_apart_than_in_the_profile_are_warned_of_as_they_may_be_a_gap(bench):
    bench.show("front", lambda seed: bench.lane(seed, places=WIDE))

    rows = bench.check(bench.crop)["front camera rows"]

    assert rows.verdict is Verdict.WARNING
    assert float(rows.figure.split()[2]) == pytest.approx(0.55, abs=0.06)
    assert "middle of a lane" in rows.advice


def test_the_wide_pattern_is_well_with_a_profile_of_it(bench):
    bench.show("front", lambda seed: bench.lane(seed, places=WIDE, radius_m=0.13))

    rows = bench.check(load_crop("beans"))["front camera rows"]

    assert rows.verdict is Verdict.OK
    assert "2 of the lane's 2 rows" in rows.figure


def test_a_lane_that_lacks_a_row_is_warned_of(bench):
    bench.show("front", lambda seed: bench.lane(seed, places=(0.35, 0.0)))

    rows = bench.check(bench.crop)["front camera rows"]

    assert rows.verdict is Verdict.WARNING
    assert "2 of the lane's 3 rows under the robot" in rows.figure


@pytest.mark.parametrize(("radius_m", "least_m", "most_m"), [(0.05, 0.06, 0.12), (0.155, 0.28, 0.34)])
def test_plants_of_another_growth_stage_are_warned_of_with_both_widths(bench, radius_m, least_m, most_m):
    bench.show("front", lambda seed: bench.lane(seed, radius_m=radius_m))

    canopy = bench.check(bench.crop)["front camera canopy"]

    assert canopy.verdict is Verdict.WARNING
    assert least_m <= float(canopy.figure.split()[0]) <= most_m
    assert "0.2 m in the profile" in canopy.figure
    assert "plants grow" in canopy.advice


def test_rows_that_the_network_does_not_bear_out_are_warned_of_with_the_switch(bench, monkeypatch):
    monkeypatch.setattr(perceive, "share_borne_out", lambda *_: 0.1)
    bench.show("front", bench.lane)

    rows = bench.check(bench.crop)["front camera rows"]

    assert (rows.verdict, rows.figure) == (Verdict.WARNING, NO_FIELD)
    assert "the network does not know this crop" in rows.advice
