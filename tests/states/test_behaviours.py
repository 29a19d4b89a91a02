"""Each behaviour on drawn pictures: what it wants of the wheels, when it has an event, and why."""

from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.estimation.lane_end import LaneEnd
from fieldnav.messages import CameraName, Direction, Frame, Side
from fieldnav.odometry import Pose
from fieldnav.perception.perceive import find
from states.acquiring import CREEP_LIMIT_M, STANDING_LOOK_S, Acquiring
from states.behaviour import Step, Task
from states.behaviours import Behaviours
from states.guide import Look
from states.guides import guide_for
from states.machine import Change
from states.memory import LaneMemory, SwitchMemory
from states.names import Event, Follow, Phase, Sidestep, text
from states.sampling import Sampling
from states.standing import CHECK_S, Checking
from states.table import LANE_LEAVES
from states.tracking import Tracking

DIRECTIONS = pytest.mark.parametrize("direction", Direction, ids=lambda direction: direction.value)
LEAVES = pytest.mark.parametrize("leaf", LANE_LEAVES, ids=text)
DT_S = 1 / 15


def judged(step: Step, name: str) -> float:
    (found,) = [each.value for each in step.evidence if each.name == name]
    return found


def lane(drawn: SimpleNamespace, number: int = 1) -> LaneMemory:
    """The memory of a lane whose rows both cameras see."""
    fit = find(drawn.picture(drawn.crop, drawn.rows(drawn.crop)), drawn.crop, drawn.camera).lane
    assert fit
    trailing = Look(fit.rows, fit.rows_seen)
    memory = LaneMemory(number=number, trailing=trailing, switch=SwitchMemory(started_m=0.0))
    guide = guide_for(drawn.task, Direction.FORWARD)
    guide.begin(fit, Frame(CameraName.FRONT, 1, 0.0, np.empty((0, 0, 3), np.uint8)), Pose())
    memory.enter(guide, LaneEnd(drawn.crop, 0.0, None))
    return memory


def drive(
    behaviour: Acquiring,
    situation: SimpleNamespace,
    images: dict[CameraName, np.ndarray],
    seconds: float,
) -> Step:
    """Obey the behaviour until it has an event or the time is over; returns its last step."""
    for _ in range(round(seconds / DT_S)):
        step = behaviour.step(situation.seen(images))
        if step.event:
            break
        situation.forward_m += step.motion.twist.vx_mps * DT_S
    return step


@DIRECTIONS
def test_acquiring_believes_rows_that_several_frames_show(
    direction: Direction, drawn: SimpleNamespace
) -> None:
    memory, situation = LaneMemory(number=1), drawn.situation()
    acquiring = Acquiring(drawn.task, direction, memory)
    images = {direction.leading: drawn.picture(drawn.crop, drawn.rows(drawn.crop))}

    assert acquiring.step(situation.seen(images)).event is None
    step = drive(acquiring, situation, images, 2.0)

    assert step.event is Event.ROWS_FOUND
    assert memory.under_way and memory.rows == drawn.crop.rows.per_lane
    assert len(memory.guide.rows(direction.leading, Pose())) == drawn.crop.rows.per_lane


@DIRECTIONS
def test_acquiring_without_rows_stands_then_creeps_boundedly_then_says_why_it_stops(
    direction: Direction, drawn: SimpleNamespace
) -> None:
    situation = drawn.situation()
    acquiring = Acquiring(drawn.task, direction, LaneMemory(number=1))
    bare = {direction.leading: drawn.picture(drawn.crop, np.empty((0, 2)))}

    standing = drive(acquiring, situation, bare, 0.9 * STANDING_LOOK_S)
    assert standing.motion.twist.vx_mps == 0.0 and situation.forward_m == 0.0
    step = drive(acquiring, situation, bare, 60.0)

    assert step.event is Event.FAIL and step.reason == "no rows found"
    assert step.motion.twist.vx_mps == 0.0
    assert CREEP_LIMIT_M < direction.sign * situation.forward_m < CREEP_LIMIT_M + 0.1
    assert judged(step, "crept") > CREEP_LIMIT_M


@DIRECTIONS
@pytest.mark.parametrize("side", Side, ids=lambda side: side.value)
def test_sampling_stands_and_describes_the_row_nearest_the_next_lane(
    direction: Direction, side: Side, drawn: SimpleNamespace
) -> None:
    task = Task(drawn.crop, drawn.task.cameras, side, 2)
    memory, situation = lane(drawn), drawn.situation()
    sampling = Sampling(task, direction, memory)
    images = {direction.trailing: drawn.picture(drawn.crop, drawn.rows(drawn.crop, from_m=1.1))}

    steps = [sampling.step(situation.seen(images)) for _ in range(6)]
    step = next(step for step in steps if step.event)

    assert all(each.motion.hold for each in steps)
    assert step.event is Event.ROW_SAMPLED
    assert memory.switch and memory.switch.crossing and memory.switch.reference is not None
    rows = memory.switch.crossing
    outermost = rows.rows[rows.outermost_old]
    assert outermost.across_m == pytest.approx(drawn.crop.rows.spacing_m, abs=0.05), "towards the next lane"


def test_checking_is_ready_when_both_cameras_and_the_modules_are(drawn: SimpleNamespace) -> None:
    situation = drawn.situation()
    checking = Checking(drawn.task)
    image = drawn.picture(drawn.crop, drawn.rows(drawn.crop))

    assert checking.step(situation.seen({CameraName.FRONT: image})).event is None
    situation.ready = False
    assert checking.step(situation.seen({CameraName.REAR: image})).event is None
    situation.ready = True
    assert checking.step(situation.seen()).event is Event.READY


def test_checking_refuses_a_camera_of_the_wrong_size(drawn: SimpleNamespace) -> None:
    situation = drawn.situation()
    image = np.zeros((480, 640, 3), np.uint8)

    step = Checking(drawn.task).step(situation.seen({CameraName.REAR: image}))

    assert step.event is Event.FAIL
    assert step.reason == "rear camera gives 640x480, its file says 320x180"


def test_checking_gives_up_on_cameras_that_stay_dark(drawn: SimpleNamespace) -> None:
    situation = drawn.situation()
    checking = Checking(drawn.task)
    checking.step(situation.seen())

    step = checking.step(situation.seen(dt_s=CHECK_S + 0.1))

    assert step.event is Event.FAIL and "do not come up" in step.reason
    assert judged(step, "cameras that give frames") == 0


def test_a_new_lane_begins_with_a_fresh_memory(drawn: SimpleNamespace) -> None:
    behaviours = Behaviours(drawn.task)
    behaviours.lane = lane(drawn)
    behaviours.lane.counts[3] += 5
    behaviours.lane.under_way = True
    entering = (Direction.FORWARD, Phase.SIDESTEP, Sidestep.ENTERING)
    acquiring = (Direction.BACKWARD, Phase.FOLLOW, Follow.ACQUIRING)

    behaviours.enter(Change(entering, Event.LANE_CENTRED, acquiring))

    assert behaviours.lane.number == 2 and not behaviours.lane.under_way and not behaviours.lane.counts
    assert isinstance(behaviours.current, Acquiring)


def test_within_a_lane_the_memory_stays(drawn: SimpleNamespace) -> None:
    behaviours = Behaviours(drawn.task)
    before = behaviours.lane
    acquiring, tracking = (
        (Direction.FORWARD, Phase.FOLLOW, leaf) for leaf in (Follow.ACQUIRING, Follow.TRACKING)
    )

    behaviours.enter(Change(acquiring, Event.ROWS_FOUND, tracking))

    assert behaviours.lane is before
    assert isinstance(behaviours.current, Tracking)


@LEAVES
def test_every_moving_state_has_a_behaviour_that_asks_for_the_cameras_it_goes_by(
    leaf: tuple[Direction, ...], drawn: SimpleNamespace
) -> None:
    behaviours = Behaviours(drawn.task)
    behaviours.lane = lane(drawn)
    behaviours.enter(Change(leaf, Event.RESUME, leaf))

    direction, cameras = leaf[0], behaviours.current.cameras
    wanted = {
        Phase.FOLLOW: {direction.leading},
        Phase.EXIT: set(CameraName),
        Phase.SIDESTEP: {direction.trailing},
    }
    assert set(cameras) <= wanted[leaf[1]]  # type: ignore[index]
    assert cameras or leaf[-1] is Sidestep.ORIENTING


@DIRECTIONS
def test_a_frame_of_the_camera_that_does_not_guide_decides_nothing(
    direction: Direction, drawn: SimpleNamespace
) -> None:
    situation = drawn.situation()
    image = drawn.picture(drawn.crop, drawn.rows(drawn.crop))
    other: dict[CameraName, Frame] = {direction.trailing: image}
    acquiring = Acquiring(drawn.task, direction, LaneMemory(number=1))

    steps = [acquiring.step(situation.seen(other)) for _ in range(10)]

    assert {step.event for step in steps} == {None}
    assert {step.motion.twist.vx_mps for step in steps} == {0.0}
