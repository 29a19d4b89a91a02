"""The true path that is noted beside a mission: how fast the wheels turn, and who else may have it."""

from collections.abc import Iterator
from math import pi

import numpy as np
import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.evaluation.path import PathObserver
from fieldnav.messages import Side, Wheel, WheelSetpoint
from fieldnav.mission.gate import Passed
from fieldnav.mission.loop import TICK_S
from fieldnav.mission.tick import Tick
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.plan import sow
from fieldnav.simulation.world import World
from states.behaviour import Step
from states.table import IDLE

ROBOT = load_robot("bonnbot")
TURNED_S = 6.0
"""By then the modules are up, and the wheels stand across."""
ACROSS = {wheel: WheelSetpoint(0.0, pi / 2) for wheel in Wheel}


@pytest.fixture
def turned() -> Iterator[PathObserver]:
    """The path of a robot that stands and turns its wheels across."""
    field = revised(load_field("demo"), {"lanes": 1, "length_m": 4})
    host, far_end = open_virtual_pair()
    world = World(
        sow(field, load_crop(field.crop), Side.RIGHT), field, ROBOT, SimulatedModules(ROBOT, far_end)
    )
    wheels, observer = ThorvaldWheels(ROBOT, host), PathObserver(world)
    wheels.start(0.0)
    for tick in range(1, round(TURNED_S / TICK_S)):
        now_s = tick * TICK_S
        world.advance(now_s)
        wheels.poll(now_s)
        if wheels.ready:
            wheels.command(now_s, ACROSS)
        observer.watch(tick_at(now_s))
        observer.watch(tick_at(now_s))  # as when a mission is broken off in the same moment
    yield observer
    host.shutdown()
    far_end.shutdown()


def tick_at(now_s: float) -> Tick:
    step = Step()
    return Tick(now_s, IDLE, None, step, Passed(step.motion, {}), 1, 3, 0, 0.0, 0.0)


def test_the_rate_at_which_the_wheels_turn_adds_up_to_how_far_they_turned(turned: PathObserver) -> None:
    rates = np.array(turned.path.steering_rate_rps)

    assert np.isfinite(rates).all()
    assert rates.sum() * TICK_S == pytest.approx(pi / 2, abs=0.05)
    assert len(rates) == len(turned.path.yaw_rate_rps) == len(turned.path.states)
    assert np.abs(turned.path.yaw_rate_rps).max() < 1e-3
