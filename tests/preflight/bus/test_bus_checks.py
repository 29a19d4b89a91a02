"""The bus itself, and who else is on it."""

from contextlib import suppress
from pathlib import Path

import can
import pytest

from drivers.thorvald_protocol import NmtCommand
from fieldnav.errors import DriverError
from fieldnav.preflight.bus_checks import counters, errors
from fieldnav.preflight.finding import Verdict
from fieldnav.preflight.gear import opened
from fieldnav.preflight.hearing import Hearing


def test_a_robot_that_is_well_is_told_so_line_by_line(bench):
    found = bench.check()

    modules = [f"module {wheel}" for wheel in ("rear_right", "front_right", "front_left", "rear_left")]
    bus = ["bus frames", "bus errors", "other hosts", *modules, "battery"]
    assert list(found) == ["disk", "clock", "computer", *bus, "two cameras"]
    assert {found[check].verdict for check in bus} == {Verdict.OK}
    rate, load = found["bus frames"].figure.split(" a second, load ")
    assert 300 < float(rate) < 420  # 81 a second of each module, and the battery's
    assert 0.06 < float(load.rstrip("%")) / 100 < 0.1


def test_nothing_moves_and_nothing_is_sent_but_zero_start_mode_questions_and_heartbeats(bench):
    bench.check()

    sent = bench.sent()
    drives = [frame for frame in sent if frame.arbitration_id in range(0x201, 0x205)]
    assert drives and all(frame.data[4:] == bytes(4) for frame in drives)
    angles = [frame for frame in sent if frame.arbitration_id in range(0x501, 0x505)]
    assert all(frame.data[4:] == bytes(4) for frame in angles)
    questions = [frame for frame in sent if frame.arbitration_id in range(0x601, 0x605)]
    assert questions and {frame.data[:4].hex() for frame in questions} == {"40122100", "40062101"}
    modes = [frame for frame in sent if frame.arbitration_id in range(0x401, 0x405)]
    assert modes and all(frame.data == bytes(8) for frame in modes)
    commands = {frame.data[0] for frame in sent if frame.arbitration_id == 0}
    assert commands == {NmtCommand.START}
    assert all(module.motion.speed_mps == 0 for module in bench.modules.modules.values())


def test_the_bus_is_listened_to_for_a_second_before_the_first_word(bench):
    bench.check()

    assert bench.sent()[0].timestamp >= 1.0


def test_a_robot_that_is_well_is_known_within_three_seconds_and_a_silent_one_within_five(bench):
    bench.check()
    well_s = bench.now_s
    for module in bench.modules.modules.values():
        module.silent = True
    bench.check()

    assert well_s <= 3
    assert bench.now_s - well_s <= 5


def test_a_bus_without_a_frame_fails_and_says_where_to_look(bench):
    bench.running = False

    found = bench.check()

    assert found["bus frames"].verdict is Verdict.FAIL
    assert "none within 3.0 s" in found["bus frames"].figure
    assert "can.bitrate" in found["bus frames"].advice
    assert found["battery"].verdict is Verdict.WARNING


def test_a_bus_that_is_gone_fails_once_instead_of_for_every_module(bench):
    bench.events.append(bench.host.shutdown)

    found = bench.check()

    assert found["bus frames"].verdict is Verdict.FAIL
    assert found["bus frames"].figure == "cannot be read: Cannot operate on a closed bus"
    assert not [check for check in found if check.startswith("module")]


def test_a_bus_that_others_fill_fails_with_its_load(bench):
    flood = can.Message(arbitration_id=0x7F0, data=bytes(8), is_extended_id=False)
    bench.events.append(lambda: [bench.far.send(flood) for _ in range(50)])

    found = bench.check()

    assert found["bus frames"].verdict is Verdict.FAIL
    assert float(found["bus frames"].figure.split("load ")[1].split("%")[0]) > 60


def test_error_frames_are_warned_of_and_bus_off_fails(bench):
    noise = can.Message(is_error_frame=True, arbitration_id=0x08)
    bench.events.append(lambda: bench.far.send(noise) if bench.now_s == 0.5 else None)
    warned = bench.check()["bus errors"]
    bench.events[:] = [lambda: bench.far.send(can.Message(is_error_frame=True, arbitration_id=0x40))]
    failed = bench.check()["bus errors"]

    assert (warned.verdict, warned.figure) == (Verdict.WARNING, "1 error frames")
    assert failed.verdict is Verdict.FAIL
    assert "bus-off" in failed.figure


@pytest.mark.parametrize(
    ("state", "verdict"),
    [
        (can.BusState.ACTIVE, Verdict.OK),
        (None, Verdict.OK),
        (can.BusState.PASSIVE, Verdict.WARNING),
        (can.BusState.ERROR, Verdict.FAIL),
    ],
)
def test_the_controllers_state_counts_where_the_interface_tells_it(bench, state, verdict):
    assert errors(Hearing(bench.robot), state, {}, {}).verdict is verdict


def test_the_kernels_counters_are_told_and_warned_of_when_they_grow(bench, tmp_path: Path):
    (tmp_path / "rx_errors").write_text("3\n")
    (tmp_path / "tx_errors").write_text("0\n")
    before = counters(tmp_path)
    (tmp_path / "rx_errors").write_text("5\n")

    steady = errors(Hearing(bench.robot), None, before, before)
    grown = errors(Hearing(bench.robot), None, before, counters(tmp_path))

    assert steady.verdict is Verdict.OK and "rx_errors 3, tx_errors 0" in steady.figure
    assert grown.verdict is Verdict.WARNING and "rx_errors +2" in grown.figure
    assert counters(tmp_path / "none") == {}


def test_a_bus_that_does_not_open_fails_with_interface_and_channel(bench):
    lost = bench.robot.can.model_copy(update={"interface": "socketcan", "channel": "can-none"})
    robot = bench.robot.model_copy(update={"can": lost})

    with opened(robot, lambda: 0.0) as (gear, findings):
        assert gear.bus is None
        assert gear.cameras == {}

    assert [finding.verdict for finding in findings] == [Verdict.FAIL] * 3
    assert "socketcan, channel can-none" in findings[0].figure


@pytest.mark.parametrize("end", [KeyboardInterrupt, DriverError("gone"), None])
def test_what_was_opened_is_closed_again_however_the_check_ends(bench, end):
    virtual = bench.robot.can.model_copy(update={"interface": "virtual", "channel": "opened"})
    robot = bench.robot.model_copy(update={"can": virtual})

    with suppress(KeyboardInterrupt, DriverError), opened(robot, lambda: 0.0) as (gear, _):
        bus = gear.bus
        assert bus is not None and bus.recv(timeout=0) is None
        if end is not None:
            raise end

    with pytest.raises(can.CanError):
        bus.recv(timeout=0)
