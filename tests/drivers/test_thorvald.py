import can
import pytest

from drivers.host_line import LAST_SEQUENCE
from drivers.thorvald import ThorvaldWheels
from drivers.thorvald_protocol import Mode, Parameter
from fieldnav.errors import DriverError, SettingsError
from fieldnav.faults import FaultKind
from fieldnav.messages import Wheel, WheelSetpoint

FORWARD = WheelSetpoint(0.5, 0.0)
FL = Wheel.FRONT_LEFT  # node 3


def data_of(frames):
    return [frame.data.hex().upper() for frame in frames]


def test_the_first_frames_command_zero_and_then_start_every_node(bench):
    bench.wheels.start(0.0)

    frames = bench.frames()
    assert [frame.arbitration_id for frame in frames[:4]] == [0x201, 0x202, 0x203, 0x204]
    assert data_of(frames[:4]) == ["0100000000000000"] * 4
    assert data_of(frame for frame in frames if frame.arbitration_id == 0) == ["0101", "0102", "0103", "0104"]
    assert frames[-1].arbitration_id == 0x77F
    assert data_of(frames[-1:]) == ["05"]


def test_no_angle_is_commanded_before_the_module_has_told_its_own(bench):
    bench.wheels.start(0.0)
    bench.wheels.command(0.0, {})

    assert not [frame for frame in bench.frames() if 0x501 <= frame.arbitration_id <= 0x504]


def test_half_a_metre_a_second_and_a_right_turn_are_these_bytes(bench):
    bench.start()
    bench.frames()

    bench.wheels.command(bench.now_s, {FL: WheelSetpoint(0.5, -1.5708)})

    frames = {frame.arbitration_id: frame for frame in bench.frames()}
    assert frames[0x203].data[4:].hex().upper() == "4E010000"  # 334 per mille of 1.496 m/s
    assert frames[0x503].data.hex().upper() == "0000000002FEFFFF"  # -510 per mille of 3.078 rad
    assert frames[0x203].timestamp == bench.now_s
    assert frames[0x201].data[4:].hex() == "00000000"  # a wheel that is not mentioned stands


def test_every_command_has_a_new_sequence_number_and_the_last_is_followed_by_zero(bench):
    bench.start()
    bench.wheels._line.sequence = LAST_SEQUENCE - 1
    bench.frames()

    for _ in range(3):
        bench.wheels.command(bench.now_s, {})

    assert [data[:8] for data in data_of(bench.frames(0x201))] == ["FFFFFF7F", "00000000", "01000000"]


def test_until_the_modules_are_ready_only_zero_is_sent(bench):
    bench.wheels.start(0.0)
    bench.wheels.command(0.0, dict.fromkeys(Wheel, FORWARD))

    assert not bench.wheels.ready
    assert {data[8:] for data in data_of(bench.frames(0x201))} == {"00000000"}


def test_the_modules_become_ready_and_report_what_they_do(bench):
    bench.start()

    bench.run(1.5, WheelSetpoint(0.5, 0.3))

    assert set(bench.report.modules) == set(Wheel)
    report = bench.report.modules[FL]
    assert report.speed_mps == pytest.approx(0.5, abs=0.001)
    assert report.steering_rad == pytest.approx(0.3, abs=0.002)
    assert report.healthy
    assert report.battery_v == pytest.approx(53.4, abs=0.6)
    assert report.temperature_c >= 20
    assert bench.wheels.versions()[FL] == (1, 0, 0)


def test_the_hosts_heartbeat_comes_every_tenth_of_a_second(bench):
    bench.start()
    bench.frames()
    bench.run(1.0)

    assert len(bench.frames(0x77F)) == 10


def test_without_a_command_for_half_a_second_the_driver_sends_zero(bench):
    bench.start()
    bench.run(1.0, FORWARD)
    bench.frames()

    bench.run(0.5)
    assert not bench.frames(0x201)
    bench.tick()

    assert [data[8:] for data in data_of(bench.frames(0x201))] == ["00000000"]


def test_stop_commands_zero_at_the_present_angles_and_never_raises(bench):
    bench.start()
    bench.run(1.0, WheelSetpoint(0.5, 0.3))
    bench.frames()

    bench.wheels.stop(bench.now_s)
    frames = bench.frames()
    bench.wheels.close()
    bench.wheels.stop(bench.now_s)  # the bus is gone

    assert {frame.data[4:].hex() for frame in frames if frame.arbitration_id in range(0x201, 0x205)} == {
        "00000000"
    }
    angles = [frame for frame in frames if frame.arbitration_id == 0x503]
    assert int.from_bytes(angles[0].data[4:], "little") == 97  # 0.3 / 3.078


def test_a_silent_module_is_named_with_its_silence_and_the_limit(bench):
    bench.start()
    bench.modules.modules[FL].silent = True

    with pytest.raises(
        DriverError, match=r"front_left \(node 3\) has been silent for 2\.0\d s, limit 2\.00 s"
    ):
        bench.run(3.0)

    assert not bench.wheels.ready


def test_after_a_lost_connection_the_first_command_is_zero(bench):
    bench.start()
    bench.run(0.5, FORWARD)
    bench.modules.modules[FL].silent = True
    with pytest.raises(DriverError):
        bench.run(3.0, FORWARD)
    bench.frames()

    bench.modules.modules[FL].silent = False
    bench.tick()
    on_return = bench.frames()
    bench.wheels.command(bench.now_s, dict.fromkeys(Wheel, FORWARD))

    heard_again = next(index for index, frame in enumerate(on_return) if frame.arbitration_id == 0x183)
    after = [frame for frame in on_return[heard_again:] if 0x201 <= frame.arbitration_id <= 0x204]
    assert [frame.data[4:].hex() for frame in after] == ["00000000"] * 4
    assert [data[8:] for data in data_of(bench.frames(0x203))] == ["00000000"]


def test_a_returned_module_must_tell_its_constants_again(bench):
    bench.start()
    bench.modules.modules[FL].silent = True
    with pytest.raises(DriverError):
        bench.run(3.0)
    bench.modules.modules[FL].silent = False
    bench.tick()
    assert not bench.wheels.ready

    bench.run(2.5)  # TPDO4 tells them every other second

    assert bench.wheels.ready


def test_a_rebooted_module_is_an_error_once_and_then_is_brought_up_again(bench):
    bench.start()
    bench.run(0.5, FORWARD)
    bench.modules.modules[FL].reboot()

    with pytest.raises(DriverError, match=r"front_left \(node 3\) has left operation or rebooted"):
        bench.run(0.1, FORWARD)
    assert not bench.wheels.ready
    bench.run(0.3)

    assert bench.wheels.ready


@pytest.mark.parametrize(
    ("parameter", "text"),
    [
        (Parameter.HOME_COUNT, "HomeCount is 7 in the module but 0 in the robot file"),
        (Parameter.DRIVE_DIRECTION, "DriveDirection is 7 in the module but 1 in the robot file"),
    ],
)
def test_a_module_with_other_constants_is_refused(bench, parameter, text):
    bench.modules.modules[FL].kept[parameter] = 7
    bench.wheels.start(0.0)

    with pytest.raises(DriverError, match=rf"front_left \(node 3\): {text}"):
        bench.run(0.2)

    assert not bench.wheels.ready


def test_a_module_that_stands_in_emergency_stop_is_refused_until_a_person_releases_it(bench):
    bench.modules.modules[FL].emergency_stop = True
    bench.wheels.start(0.0)
    with pytest.raises(DriverError, match=r"front_left \(node 3\): emergency stop") as caught:
        bench.run(0.2)
    assert caught.value.fault is FaultKind.EMERGENCY_STOP
    bench.run(0.2)
    assert not bench.wheels.ready

    bench.wheels.release_emergency_stop(bench.now_s)
    bench.wheels.start(bench.now_s)
    bench.run(2.5)  # a module already operational tells its constants every other second

    assert bench.wheels.ready


def test_the_emergency_stop_is_zero_first_and_then_object_200c(bench):
    bench.start()
    bench.run(1.0, FORWARD)
    bench.frames()

    bench.wheels.emergency_stop(bench.now_s)
    frames = [frame for frame in bench.frames() if frame.arbitration_id in (0x203, 0x603)]
    bench.run(0.5, FORWARD)

    assert [frame.arbitration_id for frame in frames] == [0x203, 0x603]
    assert frames[0].data[4:].hex() == "00000000"
    assert frames[1].data.hex().upper() == "2F0C200001000000"
    report = bench.report.modules[FL]
    assert report.speed_mps == 0
    assert "power stage off" in str(report.trouble)


def test_a_module_that_never_tells_its_constants_is_named(bench):
    bench.wheels.start(0.0)
    bench.run(0.1)
    bench.modules.modules[FL].cycles_ms[Parameter.CYCLE_IDENTITY] = 10**9
    bench.run(2.5)  # what was due comes, and then nothing for long

    bench.wheels.start(bench.now_s)  # as a restarted application would

    with pytest.raises(DriverError, match=r"front_left \(node 3\) has not told its constants .* within 5 s"):
        bench.run(6.0)


def test_garbage_on_the_bus_changes_nothing(bench):
    bench.start()
    before = bench.report
    for frame in (
        can.Message(arbitration_id=0x183, is_extended_id=False, data=b"\xff" * 7),
        can.Message(arbitration_id=0x123, is_extended_id=False, data=b"\xff" * 8),
        can.Message(arbitration_id=0x183, is_extended_id=True, data=b"\xff" * 8),
        can.Message(arbitration_id=0x483, is_extended_id=False, data=b"\xff" * 8),
        can.Message(arbitration_id=0x183, is_extended_id=False, is_remote_frame=True, dlc=8),
        can.Message(arbitration_id=0x183, is_extended_id=False, is_error_frame=True),
    ):
        bench.far.send(frame)

    assert bench.wheels.poll(bench.now_s) == before
    assert bench.wheels.ready


def test_a_fault_that_may_pass_is_reported(bench):
    bench.start()
    bench.modules.modules[FL].undervoltage = True
    bench.run(0.2)

    assert bench.wheels.ready
    assert not bench.report.modules[FL].healthy
    assert bench.report.modules[Wheel.REAR_LEFT].healthy


@pytest.mark.parametrize("broken", [float("nan"), float("inf")])
def test_a_number_that_is_not_finite_is_an_error_and_zero_is_sent(bench, broken):
    bench.start()
    bench.frames()

    with pytest.raises(DriverError, match="not a finite number"):
        bench.wheels.command(bench.now_s, {FL: WheelSetpoint(broken, 0.0), Wheel.REAR_LEFT: FORWARD})

    assert {data[8:] for data in data_of(bench.frames(0x204))} == {"00000000"}


def test_a_closed_bus_is_a_driver_error(bench):
    bench.start()
    bench.wheels.close()

    with pytest.raises(DriverError, match="CAN bus cannot be read"):
        bench.wheels.poll(bench.now_s)
    with pytest.raises(DriverError, match="CAN bus cannot be written"):
        bench.wheels.command(bench.now_s, {})


def test_a_node_that_the_layout_lacks_is_refused(robot, bench):
    modules = {**robot.modules, FL: robot.modules[FL].model_copy(update={"node_id": 9})}

    with pytest.raises(SettingsError, match=r"modules\.front_left\.node_id: 9; allowed is one of 1, 2, 3, 4"):
        ThorvaldWheels(robot.model_copy(update={"modules": modules}), bench.far)


def test_modules_already_operational_are_accepted(bench):
    bench.start()
    bench.run(0.5)

    bench.wheels.start(bench.now_s)  # as a restarted application would
    bench.run(2.5)

    assert bench.wheels.ready
    assert bench.modules.modules[FL].mode is Mode.DRIVE
