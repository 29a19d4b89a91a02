"""What the loop does when something breaks: the wheels stop first, and the journal says why."""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from drivers.simulated_motion import SimulatedMotion
from fieldnav.errors import DriverError, FieldnavError, OutputError
from fieldnav.messages import CameraName
from fieldnav.mission.loop import TICK_S
from states.names import Event
from states.table import LATCHED, RECOVERABLE


def test_a_camera_that_is_gone_stops_the_wheels_and_latches(rig) -> None:
    rig.cameras[CameraName.FRONT].broken = True
    rig.run(1.0)
    assert rig.mission.course.machine.leaf == LATCHED
    assert rig.fastest_mps() == 0
    assert "the source is gone" in rig.lines()[-1].reason


def test_a_frozen_camera_stops_the_wheels_and_says_how_old_its_frame_is(rig) -> None:
    rig.cameras[CameraName.FRONT].frozen_at_s = rig.now_s
    rig.run(1.5)
    assert rig.fastest_mps() == 0
    assert any("s old" in line.reason for line in rig.lines())
    rig.run(2.0)
    assert rig.mission.course.machine.leaf == RECOVERABLE
    assert "the wheels were held for 2.0 s" in rig.lines()[-1].reason


def test_an_error_in_the_program_stops_the_wheels_before_it_is_told(rig) -> None:
    rig.cameras[CameraName.FRONT].image = np.zeros((2, 2), np.uint8)  # no colour image at all
    rig.mission.course.behaviours.current = _Raising()
    with pytest.raises(FieldnavError, match="broke off: ZeroDivisionError"):
        rig.run(0.1)
    rig.coast(1.0)
    assert rig.fastest_mps() == 0
    assert rig.mission.course.machine.leaf == LATCHED
    assert "ZeroDivisionError" in rig.lines()[-1].reason


def test_a_full_disk_stops_the_wheels(rig) -> None:
    rig.journal.full = True
    rig.cameras[CameraName.FRONT].frozen_at_s = rig.now_s
    with pytest.raises(OutputError, match="No space left"):
        rig.run(2.0)
    rig.coast(1.0)
    assert rig.fastest_mps() == 0


def test_a_transition_in_the_round_in_which_the_bus_fails_is_told_to_those_who_watch(
    rig, monkeypatch
) -> None:
    rig.proposes(Event.ROWS_LOST)

    def refuse(*_: object) -> None:
        raise DriverError("CAN bus cannot be written")

    monkeypatch.setattr(rig.wheels, "command", refuse)
    rig.run(TICK_S)
    changes = [tick.change for tick in rig.watching if tick.change is not None]
    assert [change.event for change in changes[-2:]] == [Event.ROWS_LOST, Event.LATCH]
    assert rig.lines()[-2].event == Event.ROWS_LOST.value


def test_an_observer_that_fails_is_dropped_and_the_mission_goes_on(rig) -> None:
    rig.fails_to_watch = True
    rig.run(0.5)
    assert rig.fastest_mps() > 0.3
    assert "cannot draw" in rig.lines()[-1].reason


def test_a_silent_module_ends_the_mission_only_after_time_to_stop(rig) -> None:
    next(iter(rig.modules.modules.values())).silent = True
    while not rig.mission.over:
        rig.run(TICK_S)
    assert rig.mission.course.machine.leaf == LATCHED
    others = list(rig.modules.wheel_states().values())[1:]
    assert max(abs(wheel.speed_mps) for wheel in others) == 0


def test_stuck_wheels_are_a_fault_that_says_so(rig) -> None:
    _hold_still(rig)
    rig.run(4.5)
    assert rig.mission.course.machine.leaf == RECOVERABLE, rig.lines()[-1].reason
    assert "stand still" in rig.lines()[-1].reason


def test_an_interruption_by_the_operator_is_in_the_journal(rig) -> None:
    rig.mission.break_off(rig.now_s, Event.FAIL, "interrupted by the operator")
    rig.run(1.0)
    assert rig.fastest_mps() == 0
    assert rig.lines()[-1].reason == "interrupted by the operator"


class _Raising:
    """A behaviour with a mistake in it."""

    cameras: tuple[CameraName, ...] = ()

    def step(self, seen: object) -> Callable[[], None]:
        raise ZeroDivisionError("a mistake")


def _hold_still(rig) -> None:
    """Modules that are told to drive and do not: a wheel each against a stone."""
    for module in rig.modules.modules.values():
        motion = module.motion
        motion.advance = partial(stand_still, motion)  # type: ignore[method-assign] # the fault itself


def stand_still(motion: SimulatedMotion, *_: object) -> None:
    motion.speed_mps = 0.0
