import subprocess
import sys
from importlib.resources import files
from math import pi

import can
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.module_units import (
    speed_from_per_mille,
    speed_from_rpm,
    speed_to_per_mille,
    speed_to_rpm,
    steering_from_counts,
    steering_from_per_mille,
    steering_to_counts,
    steering_to_per_mille,
)
from drivers.thorvald_protocol import IdentityPart, Kind
from drivers.wire_layout import check_nodes, wire_layout
from fieldnav.errors import SettingsError
from fieldnav.messages import Wheel
from fieldnav.settings.robot import Module

MODULE = Module(node_id=1)
FRONT_LEFT = 3


@pytest.mark.parametrize(
    ("kind", "values", "identifier", "data"),
    [
        (Kind.DRIVE, {"Sequence": 258, "DriveSpeed": -334}, 0x203, "02010000B2FEFFFF"),
        (Kind.SET_UP, {"Parameter": 2, "Value": -5}, 0x303, "02000000FBFFFFFF"),
        (Kind.MODE, {"Mode": 1, "ModeRepeated": 1}, 0x403, "0100000001000000"),
        (Kind.STEER, {"MaximumSteeringSpeed": 0, "SteeringAngle": 510}, 0x503, "00000000FE010000"),
        (
            Kind.MOTION,
            {"DriveMotorSpeed": -1000, "SteeringMotorSpeed": 2, "SteeringCounts": 43886},
            0x183,
            "18FC02006EAB0000",
        ),
        (
            Kind.LOAD,
            {"DriveCurrent": 12.5, "SteeringCurrent": -0.1, "DrivePower": 3, "SteeringPower": 4},
            0x283,
            "7D00FFFF03000400",
        ),
        (Kind.HEARTBEAT, {"State": 5}, 0x703, "05"),
        (
            Kind.SDO_REQUEST,
            {"Command": 0x2F, "Index": 0x200C, "Subindex": 0, "Value": 1},
            0x603,
            "2F0C200001000000",
        ),
        (
            Kind.SDO_REPLY,
            {"Command": 0x4F, "Index": 0x2112, "Subindex": 0, "Value": 0x10},
            0x583,
            "4F12210010000000",
        ),
        (
            Kind.IDENTITY,
            {"Part": IdentityPart.CONSTANTS, "HomeSpeed": 100, "DriveDirection": -1, "HomeCount": -2},
            0x483,
            "6400FF01FEFFFFFF",
        ),
        (
            Kind.IDENTITY,
            {
                "Part": IdentityPart.VERSION,
                "ModuleType": 9,
                "VersionPatch": 3,
                "VersionMinor": 2,
                "VersionMajor": 1,
            },
            0x483,
            "0000000209030201",
        ),
    ],
)
def test_a_telegram_has_these_bytes_and_reads_back(kind, values, identifier, data):
    frame = wire_layout().frame(1.5, FRONT_LEFT, kind, values)

    assert frame.arbitration_id == identifier
    assert frame.data.hex().upper() == data
    assert frame.timestamp == 1.5
    telegram = wire_layout().read(frame)
    assert telegram is not None
    assert (telegram.node, telegram.kind) == (FRONT_LEFT, kind)
    assert dict(telegram.values) == pytest.approx(values)


def test_the_health_telegram_has_the_healthy_flag_lowest_and_the_drive_encoder_flag_highest():
    frame = can.Message(arbitration_id=0x381, is_extended_id=False, data=bytes.fromhex("81001E00FEFF0C02"))

    telegram = wire_layout().read(frame)

    assert telegram is not None
    raised = {name for name, value in telegram.values.items() if value == 1}
    assert raised == {"ControllerHealthy", "DriveEncoderFault"}
    assert telegram.values["HighestTemperature"] == 30
    assert telegram.values["BatteryCurrent"] == pytest.approx(-0.2)
    assert telegram.values["BatteryVoltage"] == pytest.approx(52.4)


@pytest.mark.parametrize(
    "frame",
    [
        can.Message(arbitration_id=0x181, is_extended_id=False, data=b"short"),
        can.Message(arbitration_id=0x7FF, is_extended_id=False, data=bytes(8)),
        can.Message(arbitration_id=0x181, is_extended_id=True, data=bytes(8)),
        can.Message(arbitration_id=0x181, is_extended_id=False, is_remote_frame=True, dlc=8),
        can.Message(arbitration_id=0x181, is_extended_id=False, is_error_frame=True, data=bytes(8)),
        can.Message(arbitration_id=0x481, is_extended_id=False, data=bytes([0, 0, 0, 77, 0, 0, 0, 0])),
    ],
    ids=["length", "id", "extended", "remote", "error", "part"],
)
def test_a_frame_that_is_not_of_the_layout_says_nothing(frame):
    assert wire_layout().read(frame) is None


def test_half_a_metre_a_second_is_334_per_mille_of_the_motors_top_speed():
    assert speed_to_per_mille(MODULE, 0.5) == 334  # 0.5 / (3000 / 42 * pi / 30 * 0.2) = 0.3342


def test_a_right_angle_is_510_per_mille_of_the_steering_limit():
    assert steering_to_per_mille(MODULE, pi / 2) == 510  # 1.5708 / 3.078


def test_a_turn_of_the_wheel_is_four_counts_a_pulse_times_the_gear():
    assert steering_to_counts(MODULE, 2 * pi) == 175542  # 1024 * 4 * 42.857 = 175542.3
    assert steering_to_counts(Module(node_id=1, encoder_pulses=4096), 2 * pi) == 702169


@given(st.floats(-5, 5))
def test_what_goes_to_a_module_is_clipped_and_odd(value):
    for encode in (speed_to_per_mille, steering_to_per_mille):
        assert abs(encode(MODULE, value)) <= 1000
        assert encode(MODULE, -value) == -encode(MODULE, value)


@given(st.floats(-1.49, 1.49), st.floats(-3, 3))
def test_speeds_and_angles_survive_the_wire_to_half_a_step(speed_mps, steering_rad):
    sent = speed_from_per_mille(MODULE, speed_to_per_mille(MODULE, speed_mps))
    turned = steering_from_per_mille(MODULE, steering_to_per_mille(MODULE, steering_rad))

    assert sent == pytest.approx(speed_mps, abs=0.00075)
    assert turned == pytest.approx(steering_rad, abs=0.00155)
    assert speed_from_rpm(MODULE, speed_to_rpm(MODULE, speed_mps)) == pytest.approx(speed_mps, abs=0.0003)
    counts = steering_to_counts(MODULE, steering_rad)
    assert steering_from_counts(MODULE, counts) == pytest.approx(steering_rad, abs=0.00002)


def test_the_layout_describes_every_id_of_the_document():
    ids = {0x000, 0x3C1, 0x3D1, 0x3E1, 0x77F}
    bases = (0x80, 0x180, 0x200, 0x280, 0x300, 0x380, 0x400, 0x480, 0x500, 0x580, 0x600, 0x700)
    ids |= {base + node for base in bases for node in (1, 2, 3, 4)}

    assert {identifier for identifier in range(0x800) if is_described(identifier)} == ids


def is_described(identifier):
    """Whether frames of this id are read, at whatever length; the fourth byte names TPDO4's first part."""
    data = bytes([0, 0, 0, IdentityPart.CONSTANTS, 0, 0, 0, 0])
    frames = (
        can.Message(arbitration_id=identifier, is_extended_id=False, data=data[:length])
        for length in range(9)
    )
    return any(wire_layout().read(frame) is not None for frame in frames)


def test_the_nodes_of_a_robot_that_the_layout_has_are_accepted(robot):
    check_nodes(robot)


@pytest.mark.parametrize("node_id", [5, 9, 127])
def test_a_node_that_the_layout_lacks_is_one_line_that_names_the_key_the_value_and_what_is_allowed(
    robot, node_id
):
    module = robot.modules[Wheel.FRONT_LEFT].model_copy(update={"node_id": node_id})
    odd = robot.model_copy(update={"modules": {**robot.modules, Wheel.FRONT_LEFT: module}})

    with pytest.raises(SettingsError) as caught:
        check_nodes(odd)

    assert str(caught.value) == (
        f"robot test-robot: modules.front_left.node_id: {node_id}; "
        "allowed is one of 1, 2, 3, 4, the nodes of thorvald.dbc"
    )


def test_cantools_names_a_line_of_our_log():
    dbc = files("config").joinpath("thorvald.dbc")

    done = subprocess.run(
        [sys.executable, "-m", "cantools", "decode", "-s", str(dbc)],
        input="(0.020000) can0 203#01000000B2FEFFFF T\n",
        capture_output=True,
        text=True,
        check=True,
    )

    assert "Module3_RPDO1_Drive(Sequence: 1, DriveSpeed: -334 per mille)" in done.stdout
