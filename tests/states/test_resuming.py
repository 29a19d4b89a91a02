"""What is seen at standstill decides whether, and in which state, a broken-off mission goes on."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import CameraName, Direction, Side
from fieldnav.perception.perceive import find
from states.behaviour import Behaviour, Step, Task
from states.behaviours import Behaviours
from states.exiting import Exiting
from states.machine import Change
from states.memory import LaneMemory
from states.names import Event, Follow, Phase, Sidestep
from states.place import Resumption
from states.resuming import LONGEST_S, OTHER_WAY_S, WIDEST_M, ResumingLane
from states.resuming_sidestep import ResumingSidestep
from states.table import TRANSITIONS

DIRECTIONS = pytest.mark.parametrize("direction", Direction, ids=lambda direction: direction.value)
SIDES = pytest.mark.parametrize("side", Side, ids=lambda side: side.value)
DT_S = 1 / 15
MOST_FRAMES = 400
"""Half a minute: a sidestep takes a third of it."""


def look(behaviour: Behaviour, situation: SimpleNamespace, images: dict[CameraName, np.ndarray]) -> Step:
    """Let the behaviour look at the same pictures until it has an event."""
    for _ in range(round(2 * LONGEST_S / DT_S)):
        step = behaviour.step(situation.seen(images))
        assert step.motion.twist == Step().motion.twist, "nothing moves before what is seen fits"
        if step.event:
            break
    return step


def in_lane(direction: Direction, phase: Phase = Phase.FOLLOW, number: int = 2) -> Resumption:
    leaf = (direction, phase, Follow.ACQUIRING) if phase is Phase.FOLLOW else (direction, phase)
    return Resumption(leaf, direction, LaneMemory(number, expected_m=6.0, from_m=0.5))


@DIRECTIONS
def test_a_lane_that_is_seen_ahead_is_followed_at_once(direction: Direction, drawn: SimpleNamespace) -> None:
    known, soil = in_lane(direction), drawn.picture(drawn.crop, np.empty((0, 2)))
    behaviour = ResumingLane(drawn.task, known, known.lane)
    rows = drawn.picture(drawn.crop, drawn.rows(drawn.crop))

    step = look(behaviour, drawn.situation(), {direction.leading: rows, direction.trailing: soil})

    assert (step.event, known.lane.resumes) == (
        Event.PLACE_FITS,
        (direction, Phase.FOLLOW, Follow.TRACKING),
    )
    assert len(known.lane.guide.rows(direction.leading, drawn.situation().pose)) == drawn.crop.rows.per_lane
    assert known.lane.first_crop_m == 0.5


@DIRECTIONS
@pytest.mark.parametrize("phase", [Phase.FOLLOW, Phase.EXIT])
def test_a_lane_that_is_seen_behind_alone_is_left(
    direction: Direction, phase: Phase, drawn: SimpleNamespace
) -> None:
    known, situation = in_lane(direction, phase), drawn.situation()
    behaviour = ResumingLane(drawn.task, known, known.lane)
    images = {
        direction.trailing: drawn.picture(drawn.crop, drawn.rows(drawn.crop)),
        direction.leading: drawn.picture(drawn.crop, np.empty((0, 2))),
    }

    step = look(behaviour, situation, images)

    assert (step.event, known.lane.resumes) == (Event.PLACE_FITS, (direction, Phase.EXIT))
    assert (situation.now_s > OTHER_WAY_S) == (phase is Phase.FOLLOW)
    exiting = Exiting(drawn.task, direction, known.lane)
    for _ in range(5):
        assert exiting.step(situation.seen(images)).event is None, "no crop ahead is no gap that is over"


@DIRECTIONS
def test_on_the_way_out_the_last_plants_of_the_rows_are_enough(
    direction: Direction, drawn: SimpleNamespace
) -> None:
    known, situation = in_lane(direction, Phase.EXIT), drawn.situation()
    behaviour = ResumingLane(drawn.task, known, known.lane)
    last = np.array([[1.6, drawn.crop.rows.spacing_m], [1.6, -drawn.crop.rows.spacing_m]])
    images = {direction.trailing: drawn.picture(drawn.crop, last)}
    assert find(images[direction.trailing], drawn.crop, drawn.camera).lane is None

    step = look(behaviour, situation, images)

    assert (step.event, known.lane.resumes) == (Event.PLACE_FITS, (direction, Phase.EXIT))
    assert step.reason == "plants stand behind where the lane's rows must end"
    exiting = Exiting(drawn.task, direction, known.lane)
    assert exiting.step(situation.seen(images)).event is None


@DIRECTIONS
def test_without_a_lane_ahead_and_behind_the_mission_stops_and_says_what_was_seen(
    direction: Direction, drawn: SimpleNamespace
) -> None:
    known = in_lane(direction)
    soil = drawn.picture(drawn.crop, np.empty((0, 2)))

    step = look(
        ResumingLane(drawn.task, known, known.lane), drawn.situation(), dict.fromkeys(CameraName, soil)
    )

    assert step.event is Event.FAIL
    assert step.reason.startswith("what is seen does not fit lane 2: ")
    for name in CameraName:
        assert f"{name.value} camera: no lane" in step.reason


def test_a_lane_too_far_aside_is_not_followed(drawn: SimpleNamespace) -> None:
    crop = drawn.crop.model_copy(
        update={"rows": drawn.crop.rows.model_copy(update={"per_lane": 2, "spacing_m": 0.7})}
    )
    task, known = replace(drawn.task, crop=crop), in_lane(Direction.FORWARD)
    aside = drawn.picture(crop, drawn.rows(crop, offset_m=1.2 * WIDEST_M))

    step = look(ResumingLane(task, known, known.lane), drawn.situation(), {CameraName.FRONT: aside})

    assert step.event is Event.FAIL
    assert re.search(r"front camera: 2 rows, 0\.[12]\d m off", step.reason)


def stepped_aside(
    drawn: SimpleNamespace, side: Side, direction: Direction, way_m: float
) -> tuple[SimpleNamespace, ResumingSidestep, LaneMemory]:
    """A robot so far beside a lane, told by a ledger that was 5 cm behind."""
    task = Task(drawn.crop, drawn.task.cameras, side, lanes=3)
    stepping = drawn.stepping(task, direction, drawn.lanes(task, direction))
    here = stepping.situation
    here.pose = replace(here.pose, y_m=side.sign * way_m)
    here.sideways_m = here.pose.y_m
    leaf = (direction, Phase.SIDESTEP, Sidestep.RETURNING)
    known = Resumption(leaf, direction, LaneMemory(1), moved_m=side.sign * (way_m - 0.05))
    return stepping, ResumingSidestep(task, known, known.lane), known.lane


@DIRECTIONS
@SIDES
@pytest.mark.parametrize("way_m", [0.1, 0.4, 0.8, 1.1, 1.5])
def test_rows_that_stand_where_the_wheels_say_are_counted_anew(
    way_m: float, side: Side, direction: Direction, drawn: SimpleNamespace
) -> None:
    stepping, behaviour, lane = stepped_aside(drawn, side, direction, way_m)

    step = look(behaviour, stepping.situation, {direction.trailing: stepping.look()})

    assert step.event is Event.PLACE_FITS
    at = lane.resumes
    assert at is not None
    assert at[:2] == (direction, Phase.SIDESTEP)
    near = way_m <= 0.8  # the old lane's outermost row stands in the view
    assert at[-1] is (Sidestep.CROSSING if near else Sidestep.RETURNING)
    rows = lane.switching.crossing
    assert rows is not None
    assert len(rows.rows) == drawn.crop.rows.per_lane
    # What is seen of the old lane corrects the ledger; the next lane says nothing of where the old one is.
    off_m = side.sign * lane.switching.started_m
    assert abs(off_m) < 0.02 if near else off_m == pytest.approx(0.05)


@pytest.mark.parametrize("at", [0.4, 1.5])
def test_rows_that_do_not_stand_where_the_wheels_say_stop_the_mission(
    at: float, drawn: SimpleNamespace
) -> None:
    stepping, behaviour, _ = stepped_aside(drawn, Side.RIGHT, Direction.FORWARD, at)

    step = look(behaviour, stepping.situation, {CameraName.REAR: stepping.look(np.empty((0, 2)))})

    assert step.event is Event.FAIL
    assert f"does not fit a sidestep of {at - 0.05:.2f} m from lane 1" in step.reason


def go_on(stepping: SimpleNamespace, lane: LaneMemory) -> list[Event | None]:
    """Obey the states of the sidestep as the table has them, from where it is taken up; their events."""
    behaviours, leaf, events = Behaviours(stepping.task), lane.resumes, []
    behaviours.lane = lane
    while leaf is not None and Phase.SIDESTEP in leaf and Event.FAIL not in events:
        behaviours.enter(Change(leaf, Event.PLACE_FITS, leaf))
        event = stepping.obey(behaviours.current, MOST_FRAMES).event
        events.append(event)
        leaf = next((row.target for row in TRANSITIONS if (row.source, row.event) == (leaf, event)), None)
    return events


@SIDES
def test_a_sidestep_taken_up_half_way_goes_back_and_ends_in_the_next_lane(
    side: Side, drawn: SimpleNamespace
) -> None:
    stepping, behaviour, lane = stepped_aside(drawn, side, Direction.FORWARD, 1.0)
    look(behaviour, stepping.situation, {CameraName.REAR: stepping.look()})
    assert lane.resumes is not None

    events = go_on(stepping, lane)

    assert events == [
        Event.OLD_LANE_SEEN,
        Event.ROWS_CROSSED,
        Event.LANE_REACHED,
        Event.LANE_VERIFIED,
        Event.LANE_CENTRED,
    ]
    assert abs(stepping.way_m - drawn.pitch_m) < 0.05
