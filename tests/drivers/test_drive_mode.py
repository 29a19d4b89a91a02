"""The drive mode: set by the host, read back before anything moves, and again and again while it drives."""

from typing import Any

import pytest

from drivers.listening_bus import ListeningBus
from drivers.module_link import MAX_UNANSWERED
from drivers.takeover import QUIET_S
from drivers.thorvald import RETRY_S, ThorvaldWheels
from drivers.thorvald_protocol import Kind, Mode, RoboteqObject, SdoCommand
from drivers.wire_layout import wire_layout
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind
from fieldnav.messages import Wheel, WheelSetpoint

FL = Wheel.FRONT_LEFT  # node 3
MODE_FL = 0x403
QUESTION = "4006210100000000"
FORWARD = WheelSetpoint(0.4, 0.0)
Bench = Any
"""The driver and the modules on a virtual bus, of conftest."""


def told(bench: Bench, seconds: float) -> list[FaultKind]:
    """Let time pass with all wheels told to drive; what the driver raised meanwhile."""
    raised = []
    until_s = bench.now_s + seconds
    while bench.now_s < until_s:
        try:
            bench.run(0.02, FORWARD)
        except DriverError as error:
            raised.append(error.fault)
    return raised


def foreign_mode(bench: Bench, mode: Mode) -> None:
    """Somebody else sets the mode of node 3."""
    values = {"Mode": mode, "ModeRepeated": mode}
    bench.tap.send(wire_layout().frame(bench.now_s, 3, Kind.MODE, values))


def test_the_start_sets_the_mode_and_asks_for_it(bench: Bench) -> None:
    bench.wheels.start(0.0)

    frames = bench.frames()
    assert [frame.data.hex() for frame in frames if frame.arbitration_id == MODE_FL] == ["00" * 8]
    asked = [frame.data.hex() for frame in frames if frame.arbitration_id == 0x603]
    assert QUESTION in asked


@pytest.mark.parametrize("mode", [Mode.HOME, Mode.DECOUPLED])
def test_a_module_that_was_left_in_another_mode_is_set_to_drive_before_the_wheels_are_ready(
    bench: Bench, mode: Mode
) -> None:
    bench.modules.modules[FL].mode = mode

    bench.start()

    assert bench.modules.modules[FL].mode is Mode.DRIVE


def test_a_module_that_does_not_answer_is_not_ready_and_after_five_seconds_named(bench: Bench) -> None:
    bench.modules.modules[FL].muted = frozenset({Kind.SDO_REPLY})
    bench.wheels.start(0.0)
    bench.run(4.0)
    assert not bench.wheels.ready

    with pytest.raises(
        DriverError, match=r"front_left \(node 3\) has not told its fault flags .* within 5 s"
    ):
        bench.run(1.5)


def test_an_answer_of_no_mode_that_is_known_is_told(bench: Bench) -> None:
    bench.start()
    bench.modules.modules[FL].mode = 7  # as of a script that keeps something else there

    assert told(bench, 2 * RETRY_S)[:1] == [FaultKind.MODULE_MODE]


@pytest.mark.parametrize("mode", [Mode.HOME, Mode.DECOUPLED])
def test_a_mode_set_by_a_frame_that_the_host_did_not_see_is_found_and_set_right(
    bench: Bench, mode: Mode
) -> None:
    bench.start()
    bench.run(1.0, FORWARD)
    bench.modules.modules[FL].mode = mode

    with pytest.raises(DriverError, match=f"front_left .*in mode {mode.name.lower()}, not drive") as caught:
        bench.run(RETRY_S + 0.1, FORWARD)
    assert caught.value.fault is FaultKind.MODULE_MODE
    assert not bench.wheels.ready
    bench.run(RETRY_S + 0.1)

    assert bench.modules.modules[FL].mode is Mode.DRIVE
    assert bench.wheels.ready and bench.wheels.stops is None


def test_after_a_foreign_mode_nothing_moves_until_drive_is_set_and_read_back(bench: Bench) -> None:
    bench.start()
    bench.run(1.0, FORWARD)
    foreign_mode(bench, Mode.DECOUPLED)
    assert told(bench, 0.1) == [FaultKind.FOREIGN_COMMAND]
    assert not bench.wheels.ready
    assert "module not in drive mode: " in str(bench.wheels.stops)
    bench.frames()

    assert told(bench, QUIET_S - 0.1) == []
    assert bench.frames(MODE_FL) == [], "who commands the wheels is left alone"
    assert told(bench, 0.3) == []

    assert bench.frames(MODE_FL) != []
    assert bench.modules.modules[FL].mode is Mode.DRIVE
    assert bench.wheels.ready and bench.wheels.stops is None


def test_a_remote_may_set_any_mode_for_as_long_as_it_drives(bench: Bench) -> None:
    bench.start()
    foreign_mode(bench, Mode.HOME)
    raised = told(bench, 0.1)
    for _ in range(20):
        values = {"Sequence": 7, "DriveSpeed": 0}
        bench.tap.send(wire_layout().frame(bench.now_s, 3, Kind.DRIVE, values))
        raised += told(bench, 0.4)

    assert raised == [FaultKind.FOREIGN_COMMAND]
    assert bench.modules.modules[FL].mode is Mode.HOME


def test_after_a_reboot_the_mode_is_set_and_read_back(bench: Bench) -> None:
    bench.start()
    bench.modules.modules[FL].reboot()
    bench.modules.modules[FL].mode = Mode.DECOUPLED
    with pytest.raises(DriverError, match="rebooted"):
        bench.run(0.1)
    bench.run(0.3)

    assert bench.wheels.ready
    assert bench.modules.modules[FL].mode is Mode.DRIVE


def test_a_module_that_answers_no_longer_is_an_error_while_it_drives(bench: Bench) -> None:
    bench.start()
    bench.run(6.0, FORWARD)
    bench.modules.modules[FL].muted = frozenset({Kind.SDO_REPLY})

    with pytest.raises(DriverError, match=r"front_left \(node 3\) has left 4 questions for its fault flags"):
        bench.run((MAX_UNANSWERED + 2) * RETRY_S, FORWARD)
    assert not bench.wheels.ready


def test_the_questions_cost_less_than_two_percent_of_the_bus(bench: Bench) -> None:
    bench.start()
    bench.frames()
    bench.run(2.0, FORWARD)

    frames = [each for each in bench.frames() if each.arbitration_id in range(0x581, 0x605)]
    asked = [each for each in frames if each.arbitration_id < 0x585 or each.arbitration_id > 0x600]
    assert len(asked) / 2.0 * 125 < 0.02 * 500_000


def test_a_host_that_only_listens_asks_for_nothing_and_misses_no_answer(bench: Bench) -> None:
    bench.start()
    listening = ThorvaldWheels(bench.robot, ListeningBus(bench.tap), listening=True)
    listening.start(bench.now_s)
    for _ in range(150):
        bench.tick()
        listening.poll(bench.now_s)

    assert listening.ready


def test_an_answer_that_was_on_its_way_when_another_set_the_mode_tells_nothing(bench: Bench) -> None:
    bench.start()
    foreign_mode(bench, Mode.DECOUPLED)
    values = {"Command": SdoCommand.READ_4_BYTES, "Index": RoboteqObject.USER_VARIABLE, "Subindex": 1}
    bench.far.send(wire_layout().frame(bench.now_s, 3, Kind.SDO_REPLY, {**values, "Value": Mode.DRIVE}))

    assert told(bench, 0.5) == [FaultKind.FOREIGN_COMMAND]
    assert not bench.wheels.ready


def test_a_module_is_set_to_drive_only_after_it_was_told_to_stand(bench: Bench) -> None:
    bench.start()
    bench.run(1.0, FORWARD)
    bench.frames()
    bench.modules.modules[FL].mode = Mode.DECOUPLED
    assert told(bench, 2 * RETRY_S) == [FaultKind.MODULE_MODE]

    frames = bench.frames()
    set_at = next(index for index, frame in enumerate(frames) if frame.arbitration_id == MODE_FL)
    before = [frame for frame in frames[:set_at] if frame.arbitration_id == 0x203]
    assert before and before[-1].data[4:] == bytes(4)
