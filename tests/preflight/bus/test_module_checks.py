"""Each module's line, and the battery's."""

import pytest

from drivers.thorvald_protocol import Kind, Mode, ModuleFlag, NodeState, Parameter
from fieldnav.messages import Wheel
from fieldnav.preflight.finding import Verdict

FL = Wheel.FRONT_LEFT  # node 3
LINE = "module front_left"


def others_are_well(found):
    return all(found[f"module {wheel.value}"].verdict is Verdict.OK for wheel in Wheel if wheel is not FL)


def test_a_module_that_is_well_tells_its_state_version_angle_temperature_and_voltage(bench):
    bench.modules.modules[FL].motion.steering_rad = 0.3078  # 100 per mille of the limit

    found = bench.check()

    assert found[LINE].verdict is Verdict.OK
    assert found[LINE].figure == "node 3, operational, script 1.0.0, at 17.6 deg, 22 C, 53.8 V"


def test_a_silent_module_fails_and_the_others_are_still_looked_at(bench):
    bench.modules.modules[FL].silent = True

    found = bench.check()

    assert (found[LINE].verdict, found[LINE].figure) == (Verdict.FAIL, "node 3: nothing heard")
    assert "plug" in found[LINE].advice
    assert others_are_well(found)


@pytest.mark.parametrize(
    ("parameter", "value", "words"),
    [
        (Parameter.HOME_COUNT, 812, "HomeCount is 812 in the module but 0 in the robot file"),
        (Parameter.DRIVE_DIRECTION, -1, "DriveDirection is -1 in the module but 1 in the robot file"),
    ],
)
def test_a_constant_that_is_not_the_robot_files_fails_with_both_values(bench, parameter, value, words):
    bench.modules.modules[FL].kept[parameter] = value

    found = bench.check()

    assert (found[LINE].verdict, found[LINE].figure) == (Verdict.FAIL, words)
    assert others_are_well(found)


def test_fault_flags_fail_in_words(bench):
    bench.modules.modules[FL].faults = ModuleFlag.STALL | ModuleFlag.DRIVE_ENCODER

    found = bench.check()

    assert found[LINE].verdict is Verdict.FAIL
    assert "module failed: drive encoder, stall" in found[LINE].figure


def test_an_emergency_stop_that_is_set_fails(bench):
    bench.modules.modules[FL].button_pressed = True

    found = bench.check()

    assert found[LINE].verdict is Verdict.FAIL
    assert "emergency stop pressed: power stage off, emergency stop" in found[LINE].figure
    assert "pull it out" in found[LINE].advice
    assert others_are_well(found)


def test_a_module_that_does_not_tell_its_drive_mode_fails(bench):
    bench.modules.modules[FL].muted = frozenset({Kind.SDO_REPLY})

    found = bench.check()

    assert found[LINE].verdict is Verdict.FAIL
    assert "has not told its fault flags" in found[LINE].figure
    assert others_are_well(found)


def test_a_module_that_was_left_decoupled_is_set_to_drive(bench):
    bench.modules.modules[FL].mode = Mode.DECOUPLED

    found = bench.check()

    assert found[LINE].verdict is Verdict.OK
    assert bench.modules.modules[FL].mode is Mode.DRIVE


@pytest.mark.parametrize(
    ("temperature_c", "verdict"),
    [(69, Verdict.OK), (70, Verdict.WARNING), (84, Verdict.WARNING), (85, Verdict.FAIL)],
)
def test_a_hot_module_is_warned_of_and_a_too_hot_one_fails(bench, temperature_c, verdict):
    motion = bench.modules.modules[FL].motion
    bench.events.append(lambda: setattr(motion, "temperature_c", temperature_c))

    found = bench.check()

    assert found[LINE].verdict is verdict
    assert f"{temperature_c} C" in found[LINE].figure


def test_a_wheel_that_turns_fails_with_its_speed(bench):
    motion = bench.modules.modules[FL].motion
    bench.events.append(lambda: setattr(motion, "speed_mps", 0.2))

    found = bench.check()

    assert found[LINE].verdict is Verdict.FAIL
    assert "turns at 0.19 m/s" in found[LINE].figure
    assert others_are_well(found)


def test_a_wheel_beyond_its_steering_limit_fails_with_both_angles(bench):
    bench.modules.modules[FL].motion.steering_rad = 3.3
    bench.modules.modules[FL].steering_stuck = True

    found = bench.check()

    assert found[LINE].verdict is Verdict.FAIL
    assert "stands at 189.1 deg, limit 176.4" in found[LINE].figure


def test_a_module_that_cannot_be_brought_up_fails_with_its_state(bench):
    module = bench.modules.modules[FL]
    bench.events.append(lambda: setattr(module, "state", NodeState.PRE_OPERATIONAL))

    found = bench.check()

    assert found[LINE].verdict is Verdict.FAIL
    assert "has not told an operational heartbeat, it is pre-operational" in found[LINE].figure


def test_a_module_that_reboots_meanwhile_fails(bench):
    module = bench.modules.modules[FL]
    bench.events.append(lambda: module.reboot() if bench.now_s == 1.5 else None)

    found = bench.check()

    assert found[LINE].verdict is Verdict.FAIL
    assert "rebooted" in found[LINE].figure
    assert others_are_well(found)


def test_a_module_already_in_operation_is_taken_as_it_is(bench):
    for module in bench.modules.modules.values():
        module.state = NodeState.OPERATIONAL

    found = bench.check()

    assert others_are_well(found) and found[LINE].verdict is Verdict.OK


def test_garbled_telegrams_are_counted(bench):
    told = iter([True, True])
    impossible = {"DriveMotorSpeed": 30000, "SteeringMotorSpeed": 0, "SteeringCounts": 0}
    bench.events.append(lambda: bench.say(3, Kind.MOTION, **impossible) if next(told, False) else None)

    found = bench.check()

    assert (found[LINE].verdict, found[LINE].figure) == (
        Verdict.WARNING,
        "2 telegrams say what cannot be",
    )
