"""States that stand and look: their evidence explains every step, also where a mission seldom comes."""

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import CameraName, Direction, Image
from states.acquiring import Acquiring
from states.behaviour import Behaviour, Step
from states.memory import LaneMemory, SwitchMemory
from states.names import Event, Follow, Path, Phase, Sidestep
from states.orienting import LONGEST_S, SETTLED_TICKS, Orienting
from states.place import Resumption
from states.resuming import ResumingLane
from states.resuming_sidestep import ResumingSidestep
from states.sampling import Sampling
from states.standing import CHECK_S, Checking

DT_S = 0.1
LONG_S = 30.0
"""No state of these stands for longer."""


def until_an_event(
    behaviour: Behaviour, situation: SimpleNamespace, images: dict[CameraName, Image], seconds: float
) -> list[Step]:
    """The steps of a behaviour that is shown the same again and again."""
    steps: list[Step] = []
    while situation.now_s < seconds and not (steps and steps[-1].event):
        asked = {name: images[name] for name in behaviour.cameras if name in images}
        steps.append(behaviour.step(situation.seen(asked, DT_S)))
        situation.forward_m += steps[-1].motion.twist.vx_mps * DT_S
    return steps


def bare(drawn: SimpleNamespace) -> Image:
    return drawn.picture(drawn.crop, np.empty((0, 2)))


@pytest.mark.parametrize(
    ("ready", "cameras", "size", "event"),
    [
        (True, tuple(CameraName), 1, Event.READY),
        (True, (CameraName.FRONT,), 1, Event.FAIL),
        (False, tuple(CameraName), 1, Event.FAIL),
        (True, tuple(CameraName), 2, Event.FAIL),
    ],
    ids=["all is well", "a camera lacks", "modules are not ready", "another size"],
)
def test_the_checks_are_explained(
    ready: bool,
    cameras: tuple[CameraName, ...],
    size: int,
    event: Event,
    drawn: SimpleNamespace,
    explained: Callable[[Step], None],
) -> None:
    situation = drawn.situation(ready=ready)
    images = {name: bare(drawn)[::size, ::size] for name in cameras}

    steps = until_an_event(Checking(drawn.task), situation, images, CHECK_S + 1)

    assert steps[-1].event is event
    for step in steps:
        explained(step)


@pytest.mark.parametrize(
    ("turns", "event"), [(True, Event.WHEELS_TURNED), (False, Event.FAIL)], ids=["turned", "stuck"]
)
def test_wheels_that_turn_or_do_not_are_explained(
    turns: bool, event: Event, drawn: SimpleNamespace, explained: Callable[[Step], None]
) -> None:
    orienting = Orienting(drawn.task, Direction.FORWARD, LaneMemory(number=1))

    steps = until_an_event(orienting, drawn.situation(aligned=turns), {}, LONGEST_S + 1)

    assert steps[-1].event is event
    assert not turns or len(steps) == SETTLED_TICKS + 1
    for step in steps:
        explained(step)


@pytest.mark.parametrize("shown", [True, False], ids=["rows", "bare soil"])
def test_rows_found_and_sampled_or_not_are_explained(
    shown: bool, drawn: SimpleNamespace, explained: Callable[[Step], None]
) -> None:
    image = drawn.picture(drawn.crop, drawn.rows(drawn.crop)) if shown else bare(drawn)
    wanted = {Acquiring: Event.ROWS_FOUND, Sampling: Event.ROW_SAMPLED}

    for kind, found in wanted.items():
        direction, lane = Direction.FORWARD, LaneMemory(number=1)
        lane.switch = SwitchMemory(started_m=0.0)
        steps = until_an_event(
            kind(drawn.task, direction, lane), drawn.situation(), dict.fromkeys(CameraName, image), LONG_S
        )
        assert steps[-1].event is (found if shown else Event.FAIL)
        for step in steps:
            explained(step)


LANE, SIDESTEP = (Phase.FOLLOW, Follow.ACQUIRING), (Phase.SIDESTEP, Sidestep.RETURNING)


@pytest.mark.parametrize(
    ("phase", "seen_by", "event"),
    [
        (LANE, (CameraName.FRONT,), Event.PLACE_FITS),
        (LANE, (CameraName.REAR,), Event.PLACE_FITS),
        (LANE, (), Event.FAIL),
        ((Phase.EXIT,), (CameraName.REAR,), Event.PLACE_FITS),
        ((Phase.EXIT,), (), Event.FAIL),
        (SIDESTEP, (CameraName.REAR,), Event.PLACE_FITS),
        (SIDESTEP, (), Event.FAIL),
    ],
    ids=[
        "in a lane, seen ahead",
        "in a lane, seen behind",
        "in a lane, not seen",
        "at its end, seen behind",
        "at its end, not seen",
        "beside it, seen",
        "beside it, not seen",
    ],
)
def test_a_place_that_fits_or_not_is_explained(
    phase: Path,
    seen_by: tuple[CameraName, ...],
    event: Event,
    drawn: SimpleNamespace,
    explained: Callable[[Step], None],
) -> None:
    lane, direction = LaneMemory(number=2), Direction.FORWARD
    known = Resumption((direction, *phase), direction, lane)
    kind = ResumingSidestep if phase is SIDESTEP else ResumingLane
    beside = drawn.stepping(drawn.task, direction, drawn.lanes(drawn.task, direction)).look()
    rows = beside if phase is SIDESTEP else drawn.picture(drawn.crop, drawn.rows(drawn.crop))
    images = {name: rows if name in seen_by else bare(drawn) for name in CameraName}

    steps = until_an_event(kind(drawn.task, known, lane), drawn.situation(), images, LONG_S)

    assert steps[-1].event is event
    for step in steps:
        explained(step)
