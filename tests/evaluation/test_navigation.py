"""`bench navigation`: what is driven, how it is judged, and what is made of it; no mission is driven here."""

from dataclasses import replace
from math import pi, radians, sqrt
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.errors import OutputError, SettingsError
from fieldnav.evaluation.benchmark import Better, Figure
from fieldnav.evaluation.campaign import Failed
from fieldnav.evaluation.navigation import NavigationPlan, failure_of, in_short
from fieldnav.evaluation.navigation_bands import over_seeds
from fieldnav.evaluation.navigation_cases import CASES, FIELDS, Case, cases_of, fits, lane_of
from fieldnav.evaluation.navigation_configurations import Configuration, configured
from fieldnav.evaluation.navigation_figures import case_figures, spread
from fieldnav.evaluation.navigation_lane import (
    CELL_M,
    Drive,
    Lane,
    by_cell,
    ended_early,
    steering_rate_rps,
    yaw_jerk_rps3,
)
from fieldnav.evaluation.navigation_plots import draw_navigation
from fieldnav.evaluation.path import TruePath
from fieldnav.messages import Direction, Side
from fieldnav.mission.loop import TICK_S
from fieldnav.mission.simulated import Run
from fieldnav.settings.crop import ControlLaw, RowFinder
from fieldnav.settings.field import ALL_ROWS
from fieldnav.settings.loading import load_crop, load_robot
from states.names import Follow, Phase

CURVED, POTATO = CASES[0], CASES[4]
TRACKING = (Direction.FORWARD, Phase.FOLLOW, Follow.TRACKING)
EXIT = (Direction.FORWARD, Phase.EXIT)
TICKS = 3000


def lane(
    case: Case = CURVED,
    way: Configuration = Configuration.DEFAULT,
    seed: int = 1,
    offset_m: float = 0.01,
    cells: int = 40,
    stops: int = 0,
    run_over: int = 0,
    reason: str = "",
) -> Lane:
    """A lane driven beside its centre line."""
    field = lane_of(case, 6.0, seed)
    run = Run(field, load_crop(field.crop), load_robot("bonnbot"), 1, Side.RIGHT, Path("nowhere"))
    return Lane(
        drive=Drive(case, way, run),
        offset_m=np.full(cells, offset_m),
        heading_rad=np.full(cells, radians(0.5)),
        largest_offset_m=2 * abs(offset_m),
        largest_heading_rad=radians(1.0),
        yaw_jerk_rps3=0.1,
        steering_rate_rps=0.2,
        run_over=run_over,
        stops=stops,
        realtime_factor=4.0,
        reason=reason,
    )


def figure_of(figures: list[Figure], case: str, metric: str) -> Figure:
    return next(figure for figure in figures if figure.case == case and metric in figure.metric)


@pytest.mark.parametrize(
    ("mean", "std", "met"), [(1.0, 0.5, True), (1.3, 0.5, False), (1.0, 1.0, False), (1.2, 0.9, True)]
)
def test_a_goal_with_a_deviation_is_met_in_both_or_not_at_all(mean: float, std: float, met: bool) -> None:
    figure = Figure("field", "error", mean, std, goal=1.2, goal_std=0.9, better=Better.LOWER)

    assert figure.met is met


def test_a_goal_with_a_deviation_is_not_met_where_none_was_measured() -> None:
    assert Figure("field", "error", 1.0, goal=1.2, goal_std=0.9, better=Better.LOWER).met is False


def test_a_lane_is_judged_over_its_length_not_over_the_time_it_took() -> None:
    along_m = np.array([0.01, 0.02, 0.03, 0.04, 0.15, 0.35])
    offset_m = np.array([0.04, 0.04, 0.04, 0.04, 0.02, -0.03])

    cells = by_cell(along_m, offset_m, 4 * CELL_M + 1e-9)

    np.testing.assert_allclose(cells, [0.04, 0.02, np.nan, -0.03])


def test_the_spread_is_of_the_size_of_errors_wherever_the_robot_was() -> None:
    found = spread(np.array([-3.0, 1.0, np.nan, 3.0, -1.0]))

    assert (found.mean, found.std) == (2.0, 1.0)


def test_the_jerk_of_a_known_swing_is_told_and_leaving_does_not_count() -> None:
    swing_rps, swing_hz = 0.1, 0.5
    path = TruePath()
    for tick in range(2 * TICKS):
        following = tick < TICKS
        path.yaw_rate_rps.append(swing_rps * np.sin(2 * pi * swing_hz * tick * TICK_S))
        path.steering_rate_rps.append(0.3 if following else 5.0)
        path.states.append(TRACKING if following else EXIT)

    assert yaw_jerk_rps3(path) == pytest.approx(swing_rps * (2 * pi * swing_hz) ** 2 / sqrt(2), rel=0.05)
    assert steering_rate_rps(path) == pytest.approx(0.3)


def test_a_path_that_never_followed_has_no_jerk() -> None:
    assert np.isnan(yaw_jerk_rps3(TruePath())) and np.isnan(steering_rate_rps(TruePath()))


def test_each_figure_stands_beside_the_other_ways_and_goals_hold_for_the_default_alone() -> None:
    lanes = [lane(way=way, seed=seed) for way in Configuration for seed in (1, 2)]

    figures = case_figures(CURVED, lanes)

    assert [figure.case for figure in figures[:3]] == [
        "sim-curved",
        "sim-curved (paper's finder)",
        "sim-curved (paper's finder and control)",
    ]
    assert len({figure.metric for figure in figures[:3]}) == 1
    assert all(figure.met is None for figure in figures if figure.case != "sim-curved")
    error = figures[0]
    assert (error.value, error.std) == (pytest.approx(1.0), pytest.approx(0.0))
    assert (error.goal, error.goal_std, error.best_known, error.met) == (1.2, 0.9, 9.01, True)
    assert "paper, simulation" in error.source


def test_a_lane_driven_in_part_does_not_pass_for_a_whole_one() -> None:
    half = lane()
    half = replace(half, offset_m=np.where(np.arange(40) < 30, half.offset_m, np.nan), stops=1)

    figures = case_figures(CURVED, [half, lane(seed=2)])

    assert figure_of(figures, "sim-curved", "length driven").value == pytest.approx(87.5)
    assert figure_of(figures, "sim-curved", "length driven").met is False
    assert figure_of(figures, "sim-curved", "stops").met is False


@pytest.mark.parametrize(
    ("completed", "share_driven", "said"),
    [(True, 1.0, ""), (True, 0.96, ""), (True, 0.6, "taken for ended after 60%"), (False, 0.6, "")],
)
def test_a_mission_that_finishes_within_the_rows_has_not_driven_its_lane(
    completed: bool, share_driven: float, said: str
) -> None:
    told = ended_early(completed, share_driven)

    assert said in told and bool(told) is bool(said)


def test_an_offset_to_one_side_is_told_with_its_side() -> None:
    figures = case_figures(CURVED, [lane(offset_m=-0.02), lane(offset_m=-0.01, seed=2)])

    bias = figure_of(figures, "sim-curved", "offset to the left")
    assert (bias.value, bias.std) == (pytest.approx(-1.5), pytest.approx(0.5))
    assert figure_of(figures, "sim-curved", "largest cross-track").value == pytest.approx(4.0)


def test_every_field_of_the_paper_has_its_case_as_long_as_the_paper_drove_it() -> None:
    lengths = {case.name: lane_of(case, None, 1).length_m for case in CASES if case.paper}

    assert lengths == {
        "sim-curved": 200,
        "sim-large-gaps": 200,
        "sim-dense-weed": 200,
        "beans": 52,
        "potato": 37,
        "coriander": 54,
        "sugar-beet": 69,
        "lemon-balm": 40,
    }


def test_the_hard_cases_miss_a_row_for_5_metres_and_all_rows_for_2() -> None:
    placed = [lane_of(case, None, 1).gaps.placed for case in CASES if case.gap_m]

    assert [(gap.row, gap.length_m) for gaps in placed for gap in gaps] == [(1, 5.0), (ALL_ROWS, 2.0)]
    assert not any(fits(case, 3.0) for case in CASES if case.gap_m)
    assert all(fits(case, None) for case in CASES)


def test_a_field_that_is_not_in_the_bench_is_refused_with_those_that_are() -> None:
    assert cases_of(("potato",)) == (POTATO,)
    with pytest.raises(SettingsError, match=r"--fields demo: unknown; allowed are sim-curved, .*potato"):
        cases_of(("potato", "demo"))
    assert {case.field for case in cases_of(())} == set(FIELDS)


@pytest.mark.parametrize("way", Configuration)
def test_a_way_changes_finder_and_law_and_nothing_that_the_crop_file_says_of_them(way: Configuration) -> None:
    crop = load_crop("sugar-beet")
    crop = crop.model_copy(
        update={
            "finding": crop.finding.model_copy(update={"neighbours": 7}),
            "control": crop.control.model_copy(update={"most_uncertain_m": 0.1}),
        }
    )

    found = configured(crop, way)

    default = way is Configuration.DEFAULT
    assert found.finding.method is (RowFinder.COMB if default else RowFinder.MOVING_VARIANCE)
    assert found.finding.neighbours == 7
    assert found.control.law is (ControlLaw.PAPER if way is Configuration.PAPER else crop.control.law)
    assert found.control.most_uncertain_m == 0.1
    assert (found == crop) is default


def test_in_short_it_drives_one_seed_of_what_was_named() -> None:
    short = in_short(NavigationPlan(fields=("beans",), seeds=9, length_m=5.0))

    assert (short.fields, short.seeds, short.length_m) == (("beans",), 1, 5.0)
    assert in_short(NavigationPlan()).fields != ()


def test_a_lane_that_stopped_is_listed_with_the_command_that_drives_it_again() -> None:
    failure = failure_of(lane(POTATO, seed=7, stops=1, reason="no row in sight"))

    assert failure is not None
    assert (failure.case, failure.reason) == ("potato, seed 7", "no row in sight")
    assert failure.again == "fieldnav simulate potato --lanes 1 --length 6 --seed 7"


def test_a_lane_that_cost_plants_or_gave_no_figures_is_listed_too() -> None:
    costly = failure_of(lane(CASES[8], Configuration.PAPER, run_over=3))
    broken = failure_of(Failed(lane().drive, "its process died"))

    assert costly is not None and costly.reason == "3 crop plants run over"
    assert costly.again == "fieldnav bench navigation --fields sugar-beet --length 6 --seed 1 --seeds 1"
    assert broken is not None and broken.reason == "its process died"
    assert failure_of(lane()) is None


def test_the_band_over_seeds_keeps_what_one_of_them_knows() -> None:
    one, other = np.full(30, 2.0), np.full(30, -4.0)
    other[10:] = np.nan

    mean, std = over_seeds([one, other])

    assert (mean[0], std[0]) == (3.0, 1.0)
    assert (mean[-1], std[-1]) == (2.0, 0.0)


def test_a_picture_a_field_and_one_of_all_are_drawn_even_of_a_lane_never_reached(tmp_path: Path) -> None:
    never = replace(lane(POTATO), offset_m=np.full(40, np.nan), heading_rad=np.full(40, np.nan))
    lanes = [lane(way=way, seed=seed) for way in Configuration for seed in (1, 2)] + [never]

    draw_navigation(tmp_path, [CURVED, POTATO, CASES[8]], lanes)

    drawn = sorted(path.name for path in tmp_path.iterdir())
    assert drawn == ["navigation-potato.png", "navigation-sim-curved.png", "navigation.png"]
    assert all(cv2.imread(str(path)) is not None for path in tmp_path.iterdir())


def test_a_picture_that_cannot_be_written_is_told_of(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"navigation-sim-curved\.png: cannot be written"):
        draw_navigation(tmp_path / "none", [CURVED], [lane()])
