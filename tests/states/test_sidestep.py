"""The sidestep's states one after the other, led by drawn pictures, as the machine would have them."""

from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import CameraName, Direction, Side, Steering
from fieldnav.perception.sidestep.meeting import all_known
from fieldnav.perception.sidestep.passing_rows import begin
from fieldnav.settings.crop import CropProfile
from states.behaviour import Step, Task
from states.behaviours import Behaviours
from states.crossing import CrossingRows
from states.entering import LONGEST_M, SURE_DEG, Entering
from states.machine import Change
from states.memory import LaneMemory, SwitchMemory
from states.names import Event, Phase, Sidestep
from states.orienting import LONGEST_S, Orienting
from states.returning import Returning
from states.settling import Settling
from states.table import TRANSITIONS
from states.verifying import FRAMES_LOOKED, Verifying

DIRECTIONS = pytest.mark.parametrize("direction", Direction, ids=lambda direction: direction.value)
SIDES = pytest.mark.parametrize("side", Side, ids=lambda side: side.value)
MOST_FRAMES = 400
"""Half a minute: a sidestep takes a third of it."""


def judged(step: Step, name: str) -> float:
    (found,) = [each.value for each in step.evidence if each.name == name]
    return found


def known(crop: CropProfile, **keys: object) -> CropProfile:
    """The profile of an agronomist who knows the drill."""
    switching = crop.switching.model_copy(update=keys)
    rows = crop.rows.model_copy(update={"lane_pitch_m": 1.5})
    return crop.model_copy(update={"rows": rows, "switching": switching})


def task_of(drawn: SimpleNamespace, side: Side = Side.RIGHT, crop: CropProfile | None = None) -> Task:
    return Task(crop or drawn.crop, drawn.task.cameras, side, lanes=2)


def at_the_end(task: Task, direction: Direction) -> LaneMemory:
    """The memory of a lane just left, the robot centred behind its rows."""
    camera, count = task.cameras[direction.trailing], task.crop.rows.per_lane
    places = [((count - 1) / 2 - row) * task.crop.rows.spacing_m for row in range(count)]
    rows = tuple(camera.row_in_image(place, 0.0) for place in places)
    crossing = begin(rows, 0.015, task.outward(direction.trailing), task.crop, camera)
    return LaneMemory(number=1, switch=SwitchMemory(0.0, crossing=crossing))


def sidestep(stepping: SimpleNamespace, lane: LaneMemory) -> list[Step]:
    """Go on from Crossing as the table has it until the sidestep is over; each state's last step."""
    behaviours, task, direction = Behaviours(stepping.task), stepping.task, stepping.direction
    behaviours.lane = lane
    leaf, steps = (direction, Phase.SIDESTEP, Sidestep.CROSSING), []
    behaviours.enter(Change(leaf, Event.RESUME, leaf))
    while leaf[:2] == (direction, Phase.SIDESTEP):
        step = stepping.obey(behaviours.current, MOST_FRAMES)
        steps.append(step)
        if step.event is None or step.event is Event.FAIL:
            break
        (target,) = [row.target for row in TRANSITIONS if (row.source, row.event) == (leaf, step.event)]
        assert target
        behaviours.enter(Change(leaf, step.event, target))
        leaf = target
    assert task is stepping.task
    return steps


@pytest.mark.parametrize(
    ("direction", "side"),
    [(Direction.FORWARD, Side.RIGHT), (Direction.BACKWARD, Side.LEFT)],
    ids=["forward, to the right", "backward, to the left"],
)
def test_the_next_lane_is_reached_centred_and_verified(
    direction: Direction, side: Side, drawn: SimpleNamespace
) -> None:
    task = task_of(drawn, side)
    stepping = drawn.stepping(task, direction, drawn.lanes(task, direction))

    steps = sidestep(stepping, at_the_end(task, direction))

    assert steps[-1].event is Event.LANE_CENTRED
    assert stepping.way_m == pytest.approx(drawn.pitch_m, abs=0.03)
    assert abs(np.degrees(stepping.situation.pose.heading_rad)) < 2.0
    assert judged(steps[0], "rows of the next lane") == 3


@pytest.mark.parametrize(
    "missing",
    [pytest.param(0, marks=pytest.mark.long), 1, pytest.param(2, marks=pytest.mark.long)],
    ids=["near", "middle", "far"],
)
def test_a_lane_with_one_row_less_is_taken_where_it_is(missing: int, drawn: SimpleNamespace) -> None:
    task = task_of(drawn, crop=known(drawn.crop))
    plants = drawn.lanes(task, Direction.FORWARD, without=((1, missing),))
    stepping = drawn.stepping(task, Direction.FORWARD, plants)

    steps = sidestep(stepping, at_the_end(task, Direction.FORWARD))

    assert steps[-1].event is Event.LANE_CENTRED
    assert stepping.way_m == pytest.approx(drawn.pitch_m, abs=0.03)


def test_lanes_switched_to_before_tell_where_one_with_a_row_less_is(drawn: SimpleNamespace) -> None:
    task = task_of(drawn)
    plants = drawn.lanes(task, Direction.FORWARD, without=((1, 0),))
    stepping = drawn.stepping(task, Direction.FORWARD, plants)
    lane = at_the_end(task, Direction.FORWARD)
    lane.pitches_m = (1.52, 1.47)

    steps = sidestep(stepping, lane)

    assert steps[-1].event is Event.LANE_CENTRED
    assert stepping.way_m == pytest.approx(drawn.pitch_m, abs=0.03)


def test_a_row_less_whose_place_nothing_tells_is_not_guessed(drawn: SimpleNamespace) -> None:
    task = task_of(drawn)
    plants = drawn.lanes(task, Direction.FORWARD, (0, 1), without=((1, 0),))
    stepping = drawn.stepping(task, Direction.FORWARD, plants)

    steps = sidestep(stepping, at_the_end(task, Direction.FORWARD))

    assert steps[-1].event is Event.FAIL and "missing" in steps[-1].reason


def test_without_a_next_lane_the_robot_stops_within_the_bound_and_says_so(drawn: SimpleNamespace) -> None:
    task = task_of(drawn)
    stepping = drawn.stepping(task, Direction.FORWARD, drawn.lanes(task, Direction.FORWARD, (0,)))

    (step,) = sidestep(stepping, at_the_end(task, Direction.FORWARD))

    assert step.event is Event.FAIL and step.motion.twist.vy_mps == 0.0
    assert step.reason == "the next lane was not found within the sidestep: no row was seen"
    assert stepping.way_m == pytest.approx(task.crop.switching.longest_sidestep_m, abs=0.05)


def test_the_lane_after_a_missing_one_is_not_taken_silently(drawn: SimpleNamespace) -> None:
    task = task_of(drawn, crop=known(drawn.crop, longest_sidestep_m=3.5))
    stepping = drawn.stepping(task, Direction.FORWARD, drawn.lanes(task, Direction.FORWARD, (0, 2)))

    steps = sidestep(stepping, at_the_end(task, Direction.FORWARD))

    assert steps[-1].event is Event.FAIL
    assert "where none was expected" in steps[-1].reason


@DIRECTIONS
def test_crop_that_reaches_towards_the_wheels_is_drawn_away_from(
    direction: Direction, drawn: SimpleNamespace
) -> None:
    task = task_of(drawn)
    plants = drawn.lanes(task, direction, nearer_m=0.3)
    stepping = drawn.stepping(task, direction, plants)
    step = stepping.obey(CrossingRows(task, direction, at_the_end(task, direction)), MOST_FRAMES)

    margin_m = drawn.camera.forward_m + task.crop.switching.crop_clearance_m
    away_m = np.abs(plants[:, 0] - stepping.situation.pose.x_m).min()

    assert step.event is Event.ROWS_CROSSED
    assert direction.sign * stepping.situation.pose.x_m > 0.1
    assert away_m > margin_m - 0.1


def test_drawing_away_from_crop_is_bounded(drawn: SimpleNamespace) -> None:
    task = task_of(drawn, crop=known(drawn.crop, longest_retreat_m=0.05))
    plants = drawn.lanes(task, Direction.FORWARD, nearer_m=0.3)
    stepping = drawn.stepping(task, Direction.FORWARD, plants)

    step = stepping.obey(
        CrossingRows(task, Direction.FORWARD, at_the_end(task, Direction.FORWARD)), MOST_FRAMES
    )

    assert step.event is Event.FAIL and step.reason == "crop of the next lane stands in the wheels' way"
    assert stepping.situation.pose.x_m < 0.1


Reached = tuple[SimpleNamespace, LaneMemory]


def reached(drawn: SimpleNamespace) -> Reached:
    """A robot that has settled at the next lane."""
    task = task_of(drawn, crop=known(drawn.crop))
    stepping = drawn.stepping(task, Direction.FORWARD, drawn.lanes(task, Direction.FORWARD))
    lane = at_the_end(task, Direction.FORWARD)
    for make in (CrossingRows, Settling):
        step = stepping.obey(make(task, Direction.FORWARD, lane), MOST_FRAMES)
    assert step.event is Event.LANE_REACHED
    return stepping, lane


@pytest.fixture(scope="module")
def settled_once(drawn: SimpleNamespace) -> Reached:
    return reached(drawn)


@pytest.fixture
def settled(settled_once: Reached) -> Reached:
    """A robot that has settled at the next lane, a copy for each test."""
    return deepcopy(settled_once)


def test_a_lane_that_does_not_look_like_one_is_refused_and_looked_for_again_from_the_old_one(
    drawn: SimpleNamespace, settled: Reached
) -> None:
    stepping, lane = settled
    task, direction = stepping.task, stepping.direction
    bare = np.empty((0, 2))

    refused = stepping.obey(Verifying(task, direction, lane), MOST_FRAMES, bare)
    back = stepping.obey(Returning(task, direction, lane), MOST_FRAMES)

    assert refused.event is Event.LANE_REFUSED
    assert refused.reason.endswith(
        "does not look like the next lane: 0 of 3 rows show plants where they should"
    )
    assert judged(refused, "rows that a fresh look shows") == 0
    assert back.event is Event.OLD_LANE_SEEN
    assert 0 < stepping.way_m < 1.0
    assert lane.switch and lane.switch.looks == 2
    assert lane.switch.crossing and not lane.switch.crossing.new
    assert sidestep(stepping, lane)[-1].event is Event.LANE_CENTRED
    assert stepping.way_m == pytest.approx(drawn.pitch_m, abs=0.04)


def test_a_lane_is_looked_for_no_more_often_than_the_profile_allows(
    drawn: SimpleNamespace, settled: Reached
) -> None:
    stepping, lane = settled
    stepping.task = task_of(drawn, crop=known(drawn.crop, attempts=1))
    here_m = stepping.way_m
    assert lane.switch
    lane.switch.refused = "it looked odd"

    step = stepping.obey(Returning(stepping.task, stepping.direction, lane), MOST_FRAMES)

    assert step.event is Event.FAIL and step.reason == "it looked odd (attempt 1 of 1)"
    assert judged(step, "looks for the next lane") == 1
    assert stepping.way_m == here_m


def test_a_return_that_does_not_find_the_old_lane_stops_where_the_sidestep_began(
    settled: Reached,
) -> None:
    stepping, lane = settled

    step = stepping.obey(Returning(stepping.task, stepping.direction, lane), MOST_FRAMES, np.empty((0, 2)))

    assert step.event is Event.FAIL and step.reason == "the lane that was left is not seen again"
    assert stepping.way_m == pytest.approx(0.0, abs=0.03)


def test_a_lane_that_lies_off_when_seen_from_near_is_settled_again(
    drawn: SimpleNamespace, settled: Reached
) -> None:
    stepping, lane = settled
    task = task_of(drawn, crop=known(drawn.crop, centred_m=0.0001))

    step = stepping.obey(Verifying(task, stepping.direction, lane), MOST_FRAMES)

    assert step.event is Event.LANE_OFF_CENTRE
    assert abs(judged(step, "distance to the new lane's centre")) > task.crop.switching.centred_m


def test_verifying_does_not_decide_on_the_first_frame(settled: Reached) -> None:
    stepping, lane = settled
    verifying = Verifying(stepping.task, stepping.direction, lane)
    bare = np.empty((0, 2))

    events = {stepping.obey(verifying, 1, bare).event for _ in range(FRAMES_LOOKED // 2)}

    assert events == {None}


def test_a_settling_that_loses_the_lane_refuses_it(drawn: SimpleNamespace) -> None:
    task = task_of(drawn)
    stepping = drawn.stepping(task, Direction.FORWARD, drawn.lanes(task, Direction.FORWARD, (0,)))

    step = stepping.obey(Settling(task, Direction.FORWARD, at_the_end(task, Direction.FORWARD)), MOST_FRAMES)

    assert step.event is Event.LANE_REFUSED
    assert stepping.way_m == 0.0


def test_the_distance_from_lane_to_lane_is_learnt_and_kept(drawn: SimpleNamespace) -> None:
    task = task_of(drawn)
    stepping = drawn.stepping(task, Direction.FORWARD, drawn.lanes(task, Direction.FORWARD))
    lane = at_the_end(task, Direction.FORWARD)

    sidestep(stepping, lane)

    assert lane.after().pitches_m == (pytest.approx(drawn.pitch_m, abs=0.04),)


def test_orienting_waits_for_standstill_and_then_for_the_wheels(drawn: SimpleNamespace) -> None:
    memory, situation = LaneMemory(number=1), drawn.situation()
    situation.stopped, situation.aligned, situation.sideways_m = False, True, 0.4
    orienting = Orienting(drawn.task, Direction.FORWARD, memory)

    rolling = [orienting.step(situation.seen()) for _ in range(20)]
    assert all(step.event is None and step.motion.steering is Steering.DIFFERENTIAL for step in rolling)
    situation.stopped, situation.aligned = True, False
    turning = [orienting.step(situation.seen()) for _ in range(20)]
    assert all(step.event is None and step.motion.hold for step in turning)
    assert turning[-1].motion.steering is Steering.OMNIDIRECTIONAL
    situation.aligned = True
    step = orienting.step(situation.seen())

    assert step.event is Event.WHEELS_TURNED and step.motion.hold
    assert memory.switch and memory.switch.started_m == 0.4


def test_wheels_that_do_not_turn_are_a_fault_with_a_reason(drawn: SimpleNamespace) -> None:
    situation = drawn.situation()
    situation.aligned = False
    orienting = Orienting(drawn.task, Direction.FORWARD, LaneMemory(number=1))

    orienting.step(situation.seen())
    step = orienting.step(situation.seen(dt_s=LONGEST_S + 0.1))

    assert step.event is Event.FAIL and step.reason == "the wheels do not turn across"


@pytest.mark.parametrize("behaviour", [CrossingRows, Settling])
@DIRECTIONS
@SIDES
def test_a_sidestep_past_its_bound_stops_and_says_so(
    behaviour: Callable[..., CrossingRows | Settling],
    direction: Direction,
    side: Side,
    drawn: SimpleNamespace,
) -> None:
    task = task_of(drawn, side)
    situation = drawn.situation()
    moving = behaviour(task, direction, at_the_end(task, direction))
    limit_m = task.crop.switching.longest_sidestep_m

    situation.sideways_m = side.sign * (limit_m - 0.01)
    assert moving.step(situation.seen()).event is None
    situation.sideways_m = side.sign * (limit_m + 0.01)
    step = moving.step(situation.seen())

    assert step.event is Event.FAIL and "lane" in step.reason
    assert step.motion.twist.vy_mps == 0.0
    assert judged(step, "moved sideways") == pytest.approx(limit_m + 0.01)


@DIRECTIONS
@SIDES
def test_crossing_moves_to_the_side_of_the_next_lane(
    direction: Direction, side: Side, drawn: SimpleNamespace
) -> None:
    task = task_of(drawn, side)
    crossing = CrossingRows(task, direction, at_the_end(task, direction))
    stepping = drawn.stepping(task, direction, drawn.lanes(task, direction))

    step = stepping.obey(crossing, 1)

    twist = step.motion.twist
    assert (twist.vx_mps, twist.vy_mps) == (0.0, side.sign * drawn.crop.speeds.sidestep_mps)
    assert step.motion.steering is Steering.OMNIDIRECTIONAL and not step.motion.hold
    assert judged(step, "rows of the next lane") == 0


def test_every_word_on_a_new_row_is_in_the_evidence(drawn: SimpleNamespace) -> None:
    task = task_of(drawn)
    stepping = drawn.stepping(task, Direction.FORWARD, drawn.lanes(task, Direction.FORWARD))
    crossing = CrossingRows(task, Direction.FORWARD, at_the_end(task, Direction.FORWARD))

    steps = [stepping.obey(crossing, 1) for _ in range(60)]

    wanted = {
        "word of the plants for a new row",
        "word of the wheels",
        "word of the features",
        "sum of the words",
    }
    told = [step for step in steps if wanted <= {each.name for each in step.evidence}]
    assert told
    for step in told:
        words = [judged(step, name) for name in sorted(wanted - {"sum of the words"})]
        assert judged(step, "sum of the words") == pytest.approx(sum(words))


def test_a_crossing_goes_on_between_frames_as_it_was(drawn: SimpleNamespace) -> None:
    task = task_of(drawn)
    stepping = drawn.stepping(task, Direction.FORWARD, drawn.lanes(task, Direction.FORWARD))
    crossing = CrossingRows(task, Direction.FORWARD, at_the_end(task, Direction.FORWARD))

    with_frame, without = stepping.obey(crossing, 1), crossing.step(stepping.situation.seen())

    assert without.motion == with_frame.motion and without.sight is None
    assert replace(without, motion=with_frame.motion).event is None


def test_the_camera_that_leads_is_not_asked_for(drawn: SimpleNamespace) -> None:
    lane = at_the_end(drawn.task, Direction.FORWARD)
    for make in (CrossingRows, Settling, Verifying, Returning, Entering):
        assert make(drawn.task, Direction.FORWARD, lane).cameras == (CameraName.REAR,)


def test_entering_goes_on_until_the_heading_is_known_well_and_no_further_than_its_bound(
    drawn: SimpleNamespace, settled: Reached
) -> None:
    stepping, lane = settled
    task, direction = stepping.task, stepping.direction
    stepping.plants_m = drawn.lanes(task, direction)
    from_m = stepping.situation.pose.x_m

    step = stepping.obey(Entering(task, direction, lane), MOST_FRAMES)

    driven_m = from_m - stepping.situation.pose.x_m
    assert step.event is Event.LANE_CENTRED
    assert judged(step, "angle known within") <= SURE_DEG or driven_m == pytest.approx(LONGEST_M, abs=0.05)
    assert 0 < driven_m < LONGEST_M + 0.05


def test_entering_a_lane_that_vanishes_stops(settled: Reached) -> None:
    stepping, lane = settled
    assert lane.switch and lane.switch.crossing
    lane.switch.crossing = all_known(lane.switch.crossing)

    step = stepping.obey(Entering(stepping.task, stepping.direction, lane), MOST_FRAMES, np.empty((0, 2)))

    assert step.event is Event.FAIL and "lost" in step.reason
    assert step.motion.twist.vx_mps == 0.0
