from math import pi

import can
import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.simulated_motion import DRIVE_RAMP_MPS2, STEERING_RATE_RPS, ModuleErrors, SimulatedMotion
from drivers.thorvald_protocol import Kind, Mode, ModuleFlag, NmtCommand, NodeState, Parameter
from drivers.wire_layout import NO_NODE, wire_layout
from fieldnav.messages import Wheel, WheelSetpoint

FL, NODE = Wheel.FRONT_LEFT, 3


class Line:
    """The host's bare end of the bus."""

    def __init__(self, robot, **options):
        self.host, self.far = open_virtual_pair()
        self.modules = SimulatedModules(robot, self.far, **options)
        self.now_s = 0.0

    def send(self, kind, node=NODE, **values):
        self.host.send(wire_layout().frame(self.now_s, node, kind, values))

    def nmt(self, command, node=NODE):
        self.send(Kind.NMT, NO_NODE, Command=command, Node=node)

    def pass_time(self, seconds):
        """Steps of 10 ms; what the modules said, as (stamp, node, kind, values)."""
        for _ in range(round(seconds * 100)):
            self.now_s = round(self.now_s + 0.01, 6)
            self.modules.step(self.now_s)
        said = []
        while (frame := self.host.recv(timeout=0)) is not None:
            telegram = wire_layout().read(frame)
            assert telegram is not None
            said.append((frame.timestamp, telegram.node, telegram.kind, telegram.values))
        return said

    def drive(self, seconds, speed=0, angle=0):
        """Command per mille at 50 Hz with new sequence numbers."""
        for _ in range(round(seconds * 50)):
            self.sequence = getattr(self, "sequence", 0) + 1
            self.send(Kind.DRIVE, Sequence=self.sequence, DriveSpeed=speed)
            self.send(Kind.STEER, MaximumSteeringSpeed=0, SteeringAngle=angle)
            self.pass_time(0.02)

    @property
    def state(self):
        return self.modules.wheel_states()[FL]


@pytest.fixture
def lines(robot):
    made = []

    def make(**options):
        made.append(Line(robot, **options))
        made[-1].modules.step(0.0)
        return made[-1]

    yield make
    for line in made:
        line.host.shutdown()
        line.far.shutdown()


@pytest.fixture
def line(lines):
    return lines()


def kinds(said):
    return {kind for _, node, kind, _ in said if node == NODE}


def test_a_module_boots_then_beats_and_says_nothing_else_until_started(line):
    said = line.pass_time(1.0)

    states = [values["State"] for _, node, kind, values in said if (node, kind) == (NODE, Kind.HEARTBEAT)]
    assert states[:2] == [NodeState.BOOT, NodeState.PRE_OPERATIONAL]
    assert len(states) == 11
    assert kinds(said) == {Kind.HEARTBEAT}


def test_before_the_start_no_command_moves_a_wheel(line):
    line.drive(0.5, speed=300, angle=200)

    assert line.state == WheelSetpoint(0.0, 0.0)


@pytest.mark.parametrize(
    ("kind", "times"),
    [(Kind.MOTION, 100), (Kind.LOAD, 20), (Kind.HEALTH, 20), (Kind.IDENTITY, 2), (Kind.HEARTBEAT, 20)],
)
def test_started_it_says_each_telegram_at_its_rate(line, kind, times):
    line.nmt(NmtCommand.START)

    said = line.pass_time(2.0)

    started = [(node, kind) for stamp_s, node, kind, _ in said if stamp_s > 0]
    assert started.count((NODE, kind)) == times
    assert {node for _, node, said_kind, _ in said if said_kind is Kind.MOTION} == {NODE}


def test_the_identity_alternates_between_constants_and_version(line):
    line.nmt(NmtCommand.START)

    said = line.pass_time(3.5)

    assert [values["Part"] for _, _, kind, values in said if kind is Kind.IDENTITY] == [1, 2, 1, 2]


def test_nmt_stops_and_resets(line):
    line.nmt(NmtCommand.START, node=0)
    assert line.modules.modules[Wheel.REAR_RIGHT].state is not NodeState.OPERATIONAL
    line.pass_time(0.1)
    assert all(module.state is NodeState.OPERATIONAL for module in line.modules.modules.values())

    line.nmt(NmtCommand.STOP)
    assert kinds(line.pass_time(0.5)) == {Kind.HEARTBEAT}
    line.nmt(NmtCommand.RESET)
    said = line.pass_time(0.5)

    assert [values["State"] for _, node, kind, values in said if node == NODE][:2] == [0x00, 0x7F]


def test_the_drive_ramps_at_its_acceleration(line):
    line.nmt(NmtCommand.START)
    line.drive(0.2, speed=1000)

    assert line.state.speed_mps == pytest.approx(0.2 * DRIVE_RAMP_MPS2, abs=0.02)
    line.drive(1.5, speed=1000)
    assert line.state.speed_mps == pytest.approx(1.496, abs=0.001)


def test_without_a_new_sequence_number_it_stops_and_holds_its_angle(line):
    line.nmt(NmtCommand.START)
    line.drive(1.0, speed=300, angle=200)
    turned = line.state.steering_rad

    for _ in range(40):  # the same number again and again
        line.send(Kind.DRIVE, Sequence=line.sequence, DriveSpeed=300)
        line.send(Kind.STEER, MaximumSteeringSpeed=0, SteeringAngle=-900)
        line.pass_time(0.02)
        if line.now_s < 1.18:
            assert line.state.speed_mps > 0.4

    assert line.state.speed_mps == 0
    # Within the watchdog's time it still obeys; from there on it holds.
    held = line.state.steering_rad
    assert held != pytest.approx(-900 / 1000 * 3.078, abs=0.1)
    assert held < turned
    line.pass_time(0.5)
    assert line.state.steering_rad == held


def test_it_resumes_its_speed_when_the_numbers_come_again(line):
    line.nmt(NmtCommand.START)
    line.drive(1.0, speed=300)
    line.pass_time(1.0)
    assert line.state.speed_mps == 0

    line.drive(1.0, speed=300)

    assert line.state.speed_mps == pytest.approx(0.449, abs=0.001)


def test_the_steering_arrives_without_swinging_and_never_faster_than_its_rate():
    motion = SimulatedMotion()
    angles, rates = [], []
    for _ in range(400):
        motion.advance(0.005, 0.0, pi / 2)
        angles.append(motion.steering_rad)
        rates.append(abs(motion.steering_rate_rps))

    assert max(rates) <= STEERING_RATE_RPS
    assert max(angles) < pi / 2 + 0.01
    assert angles[-1] == pytest.approx(pi / 2, abs=1e-4)
    assert angles[120] == pytest.approx(pi / 2, abs=0.01)  # 1.57 rad at 4 rad/s and 0.1 s of acceleration


def test_the_truth_has_the_errors_and_the_report_does_not(lines):
    line = lines(errors={FL: ModuleErrors(speed_factor=1.02, steering_zero_rad=0.01)})
    line.nmt(NmtCommand.START)
    line.drive(1.0, speed=300, angle=100)
    line.send(Kind.DRIVE, Sequence=-1, DriveSpeed=300)

    reported = [values for _, _, kind, values in line.pass_time(0.02) if kind is Kind.MOTION][-1]

    assert reported["DriveMotorSpeed"] == 900  # 300 per mille of 3000 rpm
    assert line.state.speed_mps == pytest.approx(0.4488 * 1.02, abs=1e-4)
    assert line.state.steering_rad == pytest.approx(0.3078 + 0.01, abs=1e-3)


def test_a_frame_is_acted_on_after_the_delay(lines):
    line = lines(can_delay_s=0.05)
    line.nmt(NmtCommand.START)
    line.pass_time(0.04)
    assert line.modules.modules[FL].state is NodeState.PRE_OPERATIONAL
    line.pass_time(0.02)
    assert line.modules.modules[FL].state is NodeState.OPERATIONAL


def test_homing_turns_straight_and_decoupled_obeys_nothing(line):
    line.nmt(NmtCommand.START)
    line.drive(1.0, speed=300, angle=200)
    line.send(Kind.MODE, Mode=Mode.HOME, ModeRepeated=Mode.HOME)
    line.drive(1.0, speed=300, angle=200)
    assert line.state.speed_mps == 0
    assert line.state.steering_rad == pytest.approx(0, abs=1e-4)

    line.send(Kind.MODE, Mode=Mode.DECOUPLED, ModeRepeated=Mode.DECOUPLED)
    line.drive(1.0, speed=300, angle=200)

    assert line.state.speed_mps == 0
    assert line.state.steering_rad == pytest.approx(0, abs=1e-4)


def test_a_mode_that_does_not_exist_is_an_illegal_command(line):
    line.nmt(NmtCommand.START)
    line.send(Kind.MODE, Mode=1, ModeRepeated=2)
    line.pass_time(0.1)

    assert ModuleFlag.ILLEGAL_COMMAND in ModuleFlag(line.modules.modules[FL].flags)
    assert line.modules.modules[FL].mode is Mode.DRIVE


def test_set_up_changes_constants_and_cycles(line):
    line.nmt(NmtCommand.START)
    line.send(Kind.SET_UP, Parameter=Parameter.HOME_COUNT, Value=-77)
    line.send(Kind.SET_UP, Parameter=Parameter.CYCLE_MOTION, Value=100)
    line.pass_time(0.2)

    said = line.pass_time(2.0)

    assert sum(kind is Kind.MOTION for _, _, kind, _ in said) == 20
    assert -77 in [values.get("HomeCount") for _, _, kind, values in said if kind is Kind.IDENTITY]


def test_an_emergency_stop_over_sdo_stops_tells_and_holds_until_released(line):
    line.nmt(NmtCommand.START)
    line.drive(1.0, speed=300)
    line.send(Kind.SDO_REQUEST, Command=0x2F, Index=0x200C, Subindex=0, Value=1)
    said = line.pass_time(0.1)
    line.drive(1.0, speed=300)
    stopped_mps = line.state.speed_mps

    line.send(Kind.SDO_REQUEST, Command=0x2F, Index=0x200D, Subindex=0, Value=1)
    line.drive(1.0, speed=300)

    assert [v["Command"] for _, _, kind, v in said if kind is Kind.SDO_REPLY] == [0x60]
    assert [v["ErrorCode"] for _, _, kind, v in said if kind is Kind.EMERGENCY] == [0x9000]
    assert stopped_mps == 0
    assert line.state.speed_mps == pytest.approx(0.449, abs=0.001)


def test_an_object_that_is_not_there_is_aborted(line):
    line.send(Kind.SDO_REQUEST, Command=0x40, Index=0x1234, Subindex=0, Value=0)

    replies = [values for _, _, kind, values in line.pass_time(0.05) if kind is Kind.SDO_REPLY]

    assert [(reply["Command"], reply["Index"], reply["Value"]) for reply in replies] == [
        (0x80, 0x1234, 0x06020000)
    ]


def test_driving_costs_current_and_warms_the_module_and_drains_the_battery(line):
    line.nmt(NmtCommand.START)
    line.pass_time(0.5)
    module = line.modules.modules[FL]
    idle_a, cold_c = module.motion.drive_current_a, module.motion.temperature_c
    first_v = line.modules.battery.voltage_v

    line.drive(5.0, speed=600)

    assert module.motion.drive_current_a > idle_a + 3
    assert module.motion.temperature_c > cold_c + 0.05
    assert line.modules.battery.voltage_v < first_v - 0.1


def test_how_often_time_is_told_changes_nothing(robot):
    def run(step_s):
        host, far = open_virtual_pair()
        modules = SimulatedModules(robot, far, can_delay_s=0.005)
        said = []
        for tick in range(round(1.0 / step_s) + 1):
            now_s = tick * step_s
            if round(now_s * 1000) % 20 == 0:
                nmt = {"Command": NmtCommand.START, "Node": 0}
                drive = {"Sequence": tick, "DriveSpeed": 300}
                host.send(wire_layout().frame(round(now_s, 6), NO_NODE, Kind.NMT, nmt))
                host.send(wire_layout().frame(round(now_s, 6), NODE, Kind.DRIVE, drive))
            modules.step(now_s)
            while (frame := host.recv(timeout=0)) is not None:
                said.append((frame.timestamp, frame.arbitration_id, bytes(frame.data)))
        host.shutdown()
        far.shutdown()
        return said

    assert run(0.02) == run(0.005) == run(0.001)


def test_garbage_is_passed_over(line):
    line.nmt(NmtCommand.START)
    line.pass_time(0.1)
    line.host.send(can.Message(arbitration_id=0x203, is_extended_id=False, data=b"\x01"))
    line.host.send(can.Message(arbitration_id=0x183, is_extended_id=False, data=bytes(8)))
    line.pass_time(0.1)

    assert line.modules.modules[FL].flags == ModuleFlag.HEALTHY
