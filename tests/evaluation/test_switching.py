"""`bench switching`: which switch has truly succeeded, what it came to, and what is driven for it."""

from dataclasses import replace
from math import radians
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.evaluation.benchmark import Figure
from fieldnav.evaluation.campaign import Failed
from fieldnav.evaluation.path import TruePath
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.evaluation.switching import SwitchingPlan, failures_of, in_short
from fieldnav.evaluation.switching_figures import switching_figures
from fieldnav.evaluation.switching_plots import draw_switching
from fieldnav.evaluation.switching_runs import Switched, SwitchRun, drive_switches, switch_run
from fieldnav.evaluation.switching_truth import against, switches_of
from fieldnav.messages import Direction, Side
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, load_robot, names_of, revised
from fieldnav.settings.robot import Robot
from fieldnav.simulation.plan import FieldPlan, sow
from states.names import Fault, Follow, Phase, Sidestep, Top
from states.names import Path as StatePath

PITCH_M, SPACING_M, LENGTH_M = 1.5, 0.35, 6.0
TICK_S = 0.02
SPARSE_SEED, SHORTEST_M = 4, 4.0
"""Of a crop with few plants, and of the shortest lane: quicker to draw."""
PLACES = 50
"""Ticks of each stretch of a path that is laid by hand."""
ROBOT = load_robot("bonnbot")
BEYOND_M = 1.2
"""Of the robot's centre, past the row ends, while it steps aside."""
EVEN = {"wander_m": 0, "pass_error_m": 0, "scatter_m": 0.0, "spacing_error": 0.0, "ragged_m": 0.0}


def plan_of(side: Side = Side.RIGHT, lanes: int = 3, wander_m: float = 0.0) -> FieldPlan:
    rows = load_field("demo").rows.model_dump(mode="json") | EVEN | {"wander_m": wander_m}
    field = revised(load_field("demo"), {"lanes": lanes, "length_m": LENGTH_M, "rows": rows})
    return sow(field, load_crop(field.crop), side)


def laid(
    stretches: list[tuple[StatePath, tuple[float, float], tuple[float, float]]], turned: float
) -> TruePath:
    """A path of straight stretches, each in one state, of a robot turned by an angle."""
    path = TruePath()
    for state, start, end in stretches:
        for share in np.linspace(0, 1, PLACES):
            path.stamp_s.append(len(path.states) * TICK_S)
            path.x_m.append(start[0] + share * (end[0] - start[0]))
            path.y_m.append(start[1] + share * (end[1] - start[1]))
            path.heading_rad.append(turned)
            path.states.append(state)
            path.lanes.append(1)
            path.rows_passed.append(0)
    return path


def switch_path(
    plan: FieldPlan,
    left: int = 0,
    to: float = 1.0,
    direction: Direction = Direction.FORWARD,
    turned: float = 0.0,
    after: StatePath | None = None,
) -> TruePath:
    """From the end of a lane over to `to`, in lanes, where the state `after` begins."""
    side = np.sign(plan.rows.lane_n_m[1]) * PITCH_M
    inside, beyond = (LENGTH_M - 0.5, LENGTH_M + BEYOND_M) if direction.sign > 0 else (0.5, -BEYOND_M)
    start, end = left * side, to * side
    after = after or (direction.opposite, Phase.FOLLOW, Follow.ACQUIRING)
    aside = (direction, Phase.SIDESTEP)
    return laid(
        [
            ((direction, Phase.EXIT), (inside, start), (beyond, start)),
            ((*aside, Sidestep.ORIENTING), (beyond, start), (beyond, start)),
            ((*aside, Sidestep.CROSSING), (beyond, start), (beyond, end)),
            (after, (beyond, end), (inside, end)),
        ],
        turned,
    )


def only_switch(plan: FieldPlan, path: TruePath):
    (switch,) = switches_of(plan, ROBOT, SPACING_M, path)
    return switch


@pytest.mark.parametrize("side", Side)
@pytest.mark.parametrize(("direction", "left"), [(Direction.FORWARD, 0), (Direction.BACKWARD, 1)])
def test_a_switch_to_the_next_lane_is_measured_in_every_direction(
    side: Side, direction: Direction, left: int
) -> None:
    plan = plan_of(side)
    path = switch_path(plan, left, left + 1 + 0.02 / PITCH_M, direction, radians(1.0))

    switch = only_switch(plan, path)

    assert switch.succeeded and switch.fault == ""
    assert switch.direction is direction
    assert switch.entry_offset_m == pytest.approx(side.sign * 0.02, abs=1e-6)
    assert switch.entry_angle_rad == pytest.approx(radians(1.0), abs=1e-6)
    assert switch.headland_m == pytest.approx(BEYOND_M - 0.75, abs=0.06)
    assert switch.sideways_m == pytest.approx(PITCH_M + 0.02, abs=0.01)
    assert switch.duration_s == pytest.approx(2 * PLACES * TICK_S)


@pytest.mark.parametrize(
    ("to", "said"),
    [
        (0.0, "1.50 m from the next lane"),
        (1 + 0.18 / PITCH_M, "0.18 m from the next lane"),
        (2.0, "1.50 m from the next lane"),
    ],
    ids=["the same lane", "half a row aside", "a lane too far"],
)
def test_a_switch_that_ends_elsewhere_has_failed_whatever_the_robot_believes(to: float, said: str) -> None:
    plan = plan_of()

    switch = only_switch(plan, switch_path(plan, to=to))

    assert not switch.succeeded
    assert said in switch.fault


def test_a_switch_within_half_a_rows_distance_has_succeeded() -> None:
    plan = plan_of()

    assert only_switch(plan, switch_path(plan, to=1 + 0.17 / PITCH_M)).succeeded


@pytest.mark.parametrize(
    "after", [(Top.FAULT, Fault.RECOVERABLE), (Direction.FORWARD, Phase.FOLLOW, Follow.ACQUIRING)]
)
def test_a_switch_after_which_the_next_lane_is_not_followed_has_failed(after: StatePath) -> None:
    plan = plan_of()

    switch = only_switch(plan, switch_path(plan, after=after))

    assert not switch.succeeded and switch.fault == "following never started"
    assert np.isnan(switch.entry_offset_m)


def test_a_switch_that_the_run_breaks_off_in_has_failed() -> None:
    plan = plan_of()
    whole = switch_path(plan)
    path = TruePath()
    for name in ("stamp_s", "x_m", "y_m", "heading_rad", "states", "lanes", "rows_passed"):
        setattr(path, name, getattr(whole, name)[: 2 * PLACES + 20])

    assert only_switch(plan, path).fault == "following never started"


def test_a_switch_past_the_last_lane_has_failed() -> None:
    plan = plan_of()

    assert only_switch(plan, switch_path(plan, left=2, to=3)).fault == "there is no further lane"


def test_a_path_without_a_sidestep_has_no_switches() -> None:
    assert switches_of(plan_of(), ROBOT, SPACING_M, TruePath()) == []


@pytest.mark.parametrize("direction", Direction)
def test_beyond_its_end_a_lane_goes_on_straight(direction: Direction) -> None:
    plan = plan_of(wander_m=0.05)
    ends_m = plan.s_last_m if direction is Direction.FORWARD else plan.s_first_m
    end_m = float(ends_m[1].mean())
    n = float(plan.rows.lane_n(1, end_m))

    at_end = against(plan, 1, direction, np.array([end_m, n]), 0.0)
    along_rad = -at_end[1]
    beyond = np.array([np.cos(along_rad), np.sin(along_rad)]) * direction.sign * 2.0
    further = against(plan, 1, direction, np.array([end_m, n]) + beyond, 0.0)

    assert at_end[0] == pytest.approx(0.0, abs=1e-6)
    assert further[0] == pytest.approx(0.0, abs=0.03)
    assert further[1] == pytest.approx(at_end[1], abs=radians(1.0))


def run_of(seed: int, lanes: int = 3, robot: Robot = ROBOT, folder: Path = Path("nowhere")) -> SwitchRun:
    return switch_run(seed, lanes, robot, folder)


def test_eight_seeds_have_every_crop_and_sixty_four_have_each_in_every_variant() -> None:
    runs = [run_of(seed).run for seed in range(64)]

    drawn = {(run.crop.name, run.side, run.field.rows.ragged_m, run.field.rows.spacing_error) for run in runs}
    assert {run.crop.name for run in runs[3:11]} == set(names_of(Kind.CROP))
    assert len(drawn) == 64
    assert {run.field.rows.ragged_m for run in runs} == {0.0, 0.3}
    assert {run.field.rows.spacing_error for run in runs} == {0.0, 0.1}


def test_two_hundred_switches_are_of_every_crop_to_both_sides() -> None:
    plan = SwitchingPlan()
    runs = [run_of(plan.seed + index).run for index in range(plan.switches // plan.a_run)]

    assert len({(run.crop.name, run.side) for run in runs}) == 2 * len(names_of(Kind.CROP))
    assert in_short(plan).switches < 5


def switched(seed: int = 1, to: float = 1.0, run_over: int = 0, reason: str = "") -> Switched:
    plan = plan_of()
    switches = switches_of(plan, ROBOT, SPACING_M, switch_path(plan, to=to))
    return Switched(run_of(seed), tuple(switches), 1, 0, 0, run_over, reason)


def value(figures: list[Figure], metric: str, case: str = "all crops") -> float:
    return next(figure.value for figure in figures if figure.metric == metric and figure.case == case)


def test_success_is_counted_of_each_crop_and_over_all() -> None:
    runs = [switched(1), switched(2), switched(2 + 8, to=2.0), switched(3, run_over=2)]

    figures = switching_figures(runs)

    assert value(figures, "switches attempted") == 4
    assert value(figures, "switches succeeded (%)") == 75
    crop = runs[1].wanted.run.crop.name
    assert value(figures, "switches succeeded (%)", crop) == 50
    assert value(figures, "crop plants run over") == 2
    assert value(figures, "entry: distance to the new lane (cm)") == pytest.approx(0.0, abs=1e-6)


def test_a_run_that_stops_before_its_switches_is_not_passed_over() -> None:
    stopped = replace(switched(), switches=(), reason="no row in sight")

    figures = switching_figures([stopped, switched()])

    assert value(figures, "switches never come to") == 1
    assert value(figures, "switches succeeded (%)") == 100


def test_no_switch_at_all_gives_figures_that_meet_no_goal() -> None:
    figures = switching_figures([])

    assert not any(figure.met for figure in figures if "entry" in figure.metric or "%" in figure.metric)


def test_each_failure_is_listed_with_field_crop_side_seed_and_the_command() -> None:
    run = switched(seed=4, to=2.0, run_over=3, reason="stuck")

    failures = failures_of(run, None)

    wanted = run.wanted.run
    assert {failure.case for failure in failures} == {
        f"demo, {wanted.crop.name}, {wanted.side.value}, seed 4"
    }
    assert [failure.reason for failure in failures] == [
        "switch from lane 1, forward: following starts 1.50 m from the next lane's centre line",
        "3 crop plants run over",
        "stopped: stuck",
    ]
    assert failures[0].again == "fieldnav bench switching --seed 4 --switches 2"
    assert failures_of(switched(), None) == []


def test_the_field_file_of_a_failure_is_the_field_that_was_driven(tmp_path: Path) -> None:
    failed = Failed(run_of(5), "its process died")

    (failure,) = failures_of(failed, tmp_path)

    (path,) = tmp_path.iterdir()
    side = failed.job.run.side.value
    assert failure.again == f"fieldnav simulate {path} --side {side}"
    assert load_field(path) == failed.job.run.field


def test_every_switch_and_every_entry_is_drawn(tmp_path: Path) -> None:
    draw_switching(tmp_path, [switched(1), switched(2, to=2.0), switched(3)])

    assert sorted(path.name for path in tmp_path.iterdir()) == ["entries.png", "switches.png"]
    assert all(cv2.imread(str(path)) is not None for path in tmp_path.iterdir())


def test_nothing_is_drawn_where_nothing_was_driven(tmp_path: Path) -> None:
    draw_switching(tmp_path, [])

    assert list(tmp_path.iterdir()) == []


@pytest.mark.long  # a mission with a switch: tests/test_mission.py; switches are judged in the tests above
def test_a_run_is_driven_judged_and_leaves_nothing_behind(tmp_path: Path) -> None:
    run = run_of(SPARSE_SEED, lanes=2, robot=smaller(ROBOT, 4), folder=tmp_path).run
    short = replace(run, field=revised(run.field, {"length_m": SHORTEST_M}))

    done = drive_switches(SwitchRun(short))

    (switch,) = done.switches
    assert switch.succeeded, switch.fault
    assert abs(switch.entry_offset_m) < 0.15 and 0 < switch.headland_m < 1
    assert done.reason == "" and done.attempts_wanted == 1
    assert len(switch.track.outward_m) == len(switch.track.leaves) > 50
    assert list(tmp_path.iterdir()) == []
