"""The robot in one process, the mission in another: what `run` does is real."""

import json
import signal

from drivers.simulated_module import WATCHDOG_S
from drivers.simulated_motion import DRIVE_RAMP_MPS2
from fieldnav.journal.directory import runs_in
from fieldnav.journal.ledger import last_booking

LIMIT_S = 180.0
SPEED_MPS = 0.5
BUSY_S = 1.0
"""What a machine shared with other tests may add to a time on the wall clock."""
LATE = ("loop late: two rounds of the loop", "loop late: module")
"""What is said of a process that was suspended between two rounds, or within one."""
STOPPING_S = WATCHDOG_S + SPEED_MPS / DRIVE_RAMP_MPS2 + BUSY_S


def tracking(line) -> bool:
    return line.target.endswith("Tracking")


def test_a_mission_is_killed_in_its_first_lane_and_drives_both(scene) -> None:
    run = scene.new_run("--once")
    scene.await_line(tracking, run)
    assert scene.wire.fastest_mps(during_s=2.0) > 0.2, "it drives"

    run.kill()
    scene.wire.standing_within(STOPPING_S)
    run.communicate(timeout=LIMIT_S)
    resumed = scene.run("--resume", "last", "--once", "--json")
    said, complaints = resumed.communicate(timeout=LIMIT_S)

    assert resumed.returncode == 0, (said, complaints, scene.lines[-3:])
    summary = json.loads(said)
    assert (summary["completed"], summary["lanes"]) == (True, {"done": 2, "total": 2})
    assert [line.seq for line in scene.lines] == list(range(len(scene.lines)))
    assert "Resuming" in {line.target for line in scene.lines}
    booking = last_booking(runs_in(scene.folder / "runs")[0].ledger)
    assert booking is not None and booking.finished and booking.done == (1, 2)
    truth = scene.end_server()["truth"]
    assert (truth["lanes_missed"], truth["lanes_repeated"], truth["crop_plants_run_over"]) == (0, 0, 0)
    assert truth["cross_track_cm"]["mean"] < 5


def test_a_process_that_hangs_leaves_no_wheel_turning_and_goes_on_only_when_told(scene) -> None:
    run = scene.new_run()
    scene.await_line(tracking, run)
    assert scene.wire.fastest_mps(during_s=1.5) > 0.2, "it drives"

    run.send_signal(signal.SIGSTOP)
    scene.wire.standing_within(STOPPING_S)
    assert scene.wire.fastest_mps(during_s=1.5) < 0.01, "and it stays at rest"
    run.send_signal(signal.SIGCONT)
    scene.await_line(lambda line: line.target == "Fault.Recoverable", run)

    assert scene.lines[-1].reason.startswith(LATE)
    assert scene.wire.fastest_mps(during_s=0.5) < 0.01, "it waits for a person"
    assert scene.ctl("resume").returncode == 0
    scene.await_line(tracking, run)
    assert scene.wire.fastest_mps(during_s=1.5) > 0.2, "it drives on"
    assert scene.ctl("stop").returncode == 0
    scene.wire.standing_within(STOPPING_S)
    _, complaints = run.communicate(timeout=LIMIT_S)
    assert run.returncode == 1
    assert "Traceback" not in complaints
    assert "stopped by process" in scene.lines[-1].reason


def test_a_remote_takes_over_and_the_run_pauses_until_it_is_quiet(scene) -> None:
    run = scene.new_run()
    scene.await_line(tracking, run)

    scene.wire.command(node=3, per_mille=40)
    scene.await_line(lambda line: line.target == "Paused", run)

    assert "module front_left (node 3) is commanded by another sender" in scene.lines[-1].reason
    scene.wire.standing_within(STOPPING_S)
    run.send_signal(signal.SIGINT)
    _, complaints = run.communicate(timeout=LIMIT_S)
    assert run.returncode == 130
    assert complaints.splitlines()[-1] == "error: interrupted"
    assert scene.lines[-1].reason == "interrupted by the operator"
