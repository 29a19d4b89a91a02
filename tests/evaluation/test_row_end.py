"""Lanes driven to their ends over sketched fields: ends met, missed, false, and not reached."""

from dataclasses import replace
from math import nan
from typing import Any

import numpy as np
import pytest

from drivers.simulated_motion import ModuleErrors
from fieldnav.evaluation.benchmark import Figure
from fieldnav.evaluation.campaign import Failed
from fieldnav.evaluation.row_end import figures_of
from fieldnav.evaluation.row_end_cases import RAGGED_LENGTH_M, gappy_runs, ragged_runs, smaller
from fieldnav.evaluation.row_end_drive import MISSED_M, LaneEnding, LaneRun, drive_to_end
from fieldnav.evaluation.row_end_robot import ObedientWheels
from fieldnav.evaluation.row_end_witness import Happening, Notes
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, load_robot, names_of, revised
from states.names import Event

ROBOT = load_robot("bonnbot")
SHORT_M = 5.0


def lane_run(expected_m: float | None = None, **changes: Any) -> LaneRun:
    field = revised(load_field("demo"), {"lanes": 1, "length_m": SHORT_M} | changes)
    return LaneRun(field, load_crop(field.crop), smaller(ROBOT, 4), expected_m)


RUN = lane_run()
MET = LaneEnding(RUN, 100.0, 0.05, false_end=False, stopped="", notes=Notes())


def with_gap(length_m: float) -> LaneRun:
    gap = {"lane": 1, "start_m": 4.0, "length_m": length_m}
    gaps = RUN.field.gaps.model_dump(mode="json") | {"placed": [gap]}
    return lane_run(length_m=4.0 + length_m + 2.0, gaps=gaps)


def events(ending: LaneEnding) -> list[Event]:
    return [each.event for each in ending.notes.happenings]


def values(figures: list[Figure]) -> dict[str, float]:
    return {figure.metric: figure.value for figure in figures}


@pytest.fixture(scope="module")
def alone() -> LaneEnding:
    """A lane that was driven after none."""
    return drive_to_end(RUN)


@pytest.mark.parametrize("expected_m", [None, 1.5 * SHORT_M])
def test_a_lane_is_left_where_it_ends_whatever_the_lanes_before_were_like(
    expected_m: float | None, alone: LaneEnding
) -> None:
    ending = alone if expected_m is None else drive_to_end(lane_run(expected_m))

    assert abs(ending.error_m) <= MISSED_M
    assert (ending.false_end, ending.missed, ending.stopped) == (False, False, "")
    assert ending.driven_m > SHORT_M
    assert events(ending)[-1] is Event.LAST_LANE_LEFT
    assert np.abs(ending.notes.offset_m).max() < 0.1


def test_a_lane_goes_on_behind_a_gap_of_two_metres_in_all_rows() -> None:
    ending = drive_to_end(with_gap(2.0))

    assert not ending.false_end
    assert abs(ending.error_m) <= MISSED_M


def test_a_lane_left_in_a_gap_longer_than_any_profile_has_it_ended_falsely() -> None:
    ending = drive_to_end(with_gap(4.0))

    assert ending.false_end
    assert ending.error_m < -2.0
    assert not ending.missed


def test_the_same_run_ends_the_same_twice(alone: LaneEnding) -> None:
    assert drive_to_end(RUN) == alone


def test_each_way_of_failing_is_counted_once() -> None:
    late = replace(MET, error_m=MISSED_M + 0.1)
    early = replace(MET, error_m=-MISSED_M - 0.01)
    false = replace(MET, error_m=-5.0, false_end=True)
    stopped = replace(MET, error_m=nan, stopped="no rows found")

    figures = values(figures_of("any", [MET, late, early, false, stopped, Failed(RUN, "its process died")]))

    assert figures["driven (km)"] == pytest.approx(0.5)
    assert figures["false ends"] == 1
    assert figures["ends missed by more than 0.3 m"] == 2
    assert figures["stops"] == 2
    assert figures["worst error of an end (m)"] == 5.0


def test_ends_met_reach_every_goal_and_a_false_one_does_not() -> None:
    met, false = (
        figures_of("any", lanes, goal_km=0.2)
        for lanes in ([MET, MET], [MET, replace(MET, error_m=-5.0, false_end=True)])
    )

    assert all(figure.met is not False for figure in met)
    assert [figure.metric for figure in false if figure.met is False] == [
        "false ends",
        "worst error of an end (m)",
    ]


def test_gaps_taken_for_an_end_are_counted_by_crop_that_came_again() -> None:
    again = Happening(Event.ROWS_SEEN_AGAIN, 3.0, "", ())

    figures = values(figures_of("any", [replace(MET, notes=Notes(happenings=[again, again]))]))

    assert figures["gaps taken for ends until crop came"] == 2


def test_no_lane_at_all_has_no_error_and_no_goal_reached() -> None:
    figures = figures_of("any", [], goal_km=1.0)

    assert np.isnan(values(figures)["worst error of an end (m)"])
    assert [f.met for f in figures if f.metric in ("driven (km)", "worst error of an end (m)")] == [
        False,
        False,
    ]


def test_any_eight_lanes_have_every_crop_and_both_gaps_placed() -> None:
    runs = list(gappy_runs(8, 60.0, 5, ROBOT))

    assert {run.crop.name for run in runs} == set(names_of(Kind.CROP))
    assert {len(run.field.gaps.placed) for run in runs} == {2}
    assert {run.field.length_m for run in runs} == {60.0}


def test_ragged_lanes_are_driven_after_none_after_like_ones_and_after_odd_ones() -> None:
    expected = [run.expected_m for run in ragged_runs(24, 0, ROBOT)]

    assert expected[:8] == [None] * 8
    known = [each for each in expected[8:] if each is not None]
    assert len(known) == 16
    assert max(abs(each - RAGGED_LENGTH_M) for each in known[:8]) < 1.5
    assert max(known[8:]) - min(known[8:]) > 1.0


def test_smaller_cameras_see_the_same_ground() -> None:
    large, small = (robot.cameras.front.pinhole() for robot in (ROBOT, smaller(ROBOT)))

    assert small.width_px == large.width_px // 2
    assert small.view_m == pytest.approx(large.view_m, abs=0.01)


def test_wheels_roll_as_told_but_for_their_errors() -> None:
    errors = dict.fromkeys(Wheel, ModuleErrors()) | {Wheel.REAR_LEFT: ModuleErrors(1.02, 0.01)}
    wheels = ObedientWheels(errors)

    wheels.command(0.0, dict.fromkeys(Wheel, WheelSetpoint(0.5, 0.1)))
    told = wheels.poll(0.02).modules[Wheel.REAR_LEFT]

    assert (told.stamp_s, told.speed_mps, told.steering_rad) == (0.02, 0.5, 0.1)
    assert wheels.wheel_states()[Wheel.FRONT_LEFT] == WheelSetpoint(0.5, 0.1)
    faulty = wheels.wheel_states()[Wheel.REAR_LEFT]
    assert (faulty.speed_mps, faulty.steering_rad) == pytest.approx((0.51, 0.11))
    wheels.stop(0.04)
    assert wheels.wheel_states()[Wheel.FRONT_LEFT] == WheelSetpoint(0.0, 0.1)
