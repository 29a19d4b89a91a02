"""Another host on the bus: it is named, and left alone."""

import pytest

from drivers.can_log import LoggedBus
from drivers.thorvald_protocol import Kind
from fieldnav.preflight.finding import Verdict


@pytest.mark.parametrize(
    ("node", "kind", "values", "words"),
    [
        (3, Kind.DRIVE, {"Sequence": 7, "DriveSpeed": 120}, "203 drives node 3 at 120 per mille"),
        (
            1,
            Kind.STEER,
            {"MaximumSteeringSpeed": 0, "SteeringAngle": -40},
            "501 steers node 1 to -40 per mil",
        ),
        (2, Kind.MODE, {"Mode": 1, "ModeRepeated": 1}, "402 sets node 2 to mode home"),
        (4, Kind.SET_UP, {"Parameter": 2, "Value": 99}, "304 sets parameter 2 of node 4 to 99"),
        (0, Kind.NMT, {"Command": 0x81, "Node": 0}, "000 commands reset to all nodes"),
        (0, Kind.NMT, {"Command": 0x80, "Node": 2}, "000 commands enter pre operational to node 2"),
        (0, Kind.HOST_HEARTBEAT, {"State": 5}, "77F is another host's heartbeat"),
    ],
)
def test_another_host_fails_with_its_identifier_and_what_it_commands(bench, node, kind, values, words):
    said = iter([True])
    bench.events.append(lambda: bench.say(node, kind, **values) if next(said, False) else None)

    found = bench.check()

    assert found["other hosts"].verdict is Verdict.FAIL
    assert words in found["other hosts"].figure
    assert not bench.sent()[1:], "two hosts make a robot jerk"


def test_another_host_that_begins_later_is_heard_too(bench):
    bench.events.append(lambda: bench.say(0, Kind.HOST_HEARTBEAT, State=5) if bench.now_s > 1.5 else None)

    found = bench.check()

    assert found["other hosts"].verdict is Verdict.FAIL


def test_behind_another_host_the_modules_are_not_said_to_be_broken(bench):
    bench.events.append(lambda: bench.say(0, Kind.HOST_HEARTBEAT, State=5))

    found = bench.check()

    assert found["module rear_left"].verdict is Verdict.WARNING
    assert "another host is there" in found["module rear_left"].figure


def test_the_hosts_own_frames_are_nobody_elses(bench, tmp_path):
    logged = LoggedBus(bench.host, tmp_path / "can.log", "can0")
    bench.host = logged

    found = bench.check()
    logged.shutdown()

    assert found["other hosts"].verdict is Verdict.OK
