"""A mission's process is killed again and again; what would be wrong with it is noticed; the command line."""

import signal
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from multiprocessing import Process, get_context
from pathlib import Path
from random import Random

import pytest

from fieldnav.cli.app import run
from fieldnav.evaluation.benchmark import Figure
from fieldnav.evaluation.campaign import Failed
from fieldnav.evaluation.kills_drive import soak
from fieldnav.evaluation.kills_figures import failure_lines, kills_figures
from fieldnav.evaluation.kills_mission import EPOCH, MissionSetup
from fieldnav.evaluation.kills_moment import Kill, Killer, Moment, kills
from fieldnav.evaluation.kills_runs import soak_run
from fieldnav.evaluation.kills_soaked import Soaked, SoakRun, files_faults
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.journal.ledger import Booking, Ledger
from fieldnav.journal.summary import CrossTrack, Heading, Truth
from fieldnav.settings.loading import load_robot, revised

SEEDS = (203, 236)
"""Both crops, each to another side; killed early and late."""
ONE_LANE_KILLS = 2
"""Of a mission of a single lane, which takes twelve seconds of the robot's time."""
LONG_S = 10.0
"""Within that any process is dead that was killed."""
KILLS, MEAN_S = 5, 5.0
"""Of each mission, and the time between them: two lanes take forty seconds of the robot's time."""


@pytest.fixture(scope="module")
def wanted() -> SoakRun:
    return short(SEEDS[0])


def short(seed: int) -> SoakRun:
    made = soak_run(seed, smaller(load_robot("bonnbot"), 4))
    field = revised(made.field, {"lanes": 2, "length_m": 5.0})
    return replace(made, field=field, kills=KILLS, mean_s=MEAN_S)


def one_lane(seed: int) -> SoakRun:
    made = short(seed)
    return replace(made, field=revised(made.field, {"lanes": 1, "length_m": 4.0}), kills=ONE_LANE_KILLS)


@pytest.mark.parametrize(
    "run",
    [
        pytest.param(one_lane(SEEDS[0]), id="one lane"),
        # One lane stands for two; a kill while the robot crosses is in tests/two_processes.
        *(pytest.param(short(seed), id=str(seed), marks=pytest.mark.long) for seed in SEEDS),
    ],
)
def test_a_mission_killed_at_any_moment_is_resumed_to_its_end_with_every_lane_driven_once(
    run: SoakRun,
) -> None:
    done = soak(run)

    assert done.faults == [], f"{done.run.title}; killed in {dict(done.kills)}"
    assert done.kills.total() == run.kills, f"{done.run.title}: its end came before its kills"
    assert 0.0 < done.standstill_s < 0.6  # the watchdog's 0.2 s, and the ramp from 0.5 m/s


def test_the_seed_decides_when_a_mission_is_killed() -> None:
    def first(seed: int) -> list[Kill]:
        return [kill for kill, _ in zip(kills(Random(seed)), range(200), strict=False)]

    assert first(1) == first(1) != first(2)
    moments = Counter(kill.moment for kill in first(1))
    assert all(moments[moment] > 20 for moment in Moment)
    assert min(kill.after_s for kill in first(1)) < 0.5


@pytest.fixture
def waiting() -> Iterator[Process]:
    """A process that waits to be killed."""
    process = get_context("fork").Process(target=signal.pause, daemon=True)
    process.start()
    yield process
    process.kill()
    process.join()


def test_a_process_is_killed_once_its_moment_has_come(waiting: Process, tmp_path: Path) -> None:
    killer = Killer(waiting, Kill(Moment.ANY, after_s=2.0, delay_s=0.001), tmp_path / "journal.jsonl")

    killer.time_is(1.98)
    killer.call_off()
    assert waiting.is_alive()

    killer = Killer(waiting, Kill(Moment.ANY, after_s=2.0, delay_s=0.001), tmp_path / "journal.jsonl")
    killer.time_is(2.0)
    waiting.join(LONG_S)
    assert waiting.exitcode == -signal.SIGKILL


def test_about_a_transition_a_process_is_killed_as_its_journal_grows(
    waiting: Process, tmp_path: Path
) -> None:
    path = tmp_path / "journal.jsonl"
    killer = Killer(waiting, Kill(Moment.TRANSITION, after_s=0.0, delay_s=0.0), path)
    killer.time_is(0.0)
    waiting.join(0.05)
    assert waiting.is_alive()

    while waiting.is_alive():
        path.write_bytes(b"a line\n" + (path.read_bytes() if path.exists() else b""))
        waiting.join(0.01)

    assert waiting.exitcode == -signal.SIGKILL


@pytest.fixture
def setup(wanted: SoakRun, tmp_path: Path) -> MissionSetup:
    """A run whose files say that both lanes are done."""
    made = MissionSetup(tmp_path, wanted.robot, wanted.crop, wanted.side, lanes=2)
    with Journal(made.journal, EPOCH) as journal, Ledger(made.ledger) as ledger:
        journal.record(Entry(1.0, "start", "Idle", "Checking"))
        journal.record(Entry(2.0, "last lane left", "Forward.Exit", "Finished"))
        ledger.book(booking((1, 2), finished=True))
    return made


def booking(done: tuple[int, ...], finished: bool) -> Booking:
    return Booking(
        stamp_s=2.0,
        state="Forward.Exit",
        side="left",
        lanes=2,
        lane=2,
        done=done,
        rows=3,
        forward_m=0.0,
        sideways_m=0.0,
        finished=finished,
    )


def test_files_of_a_finished_mission_are_in_order(setup: MissionSetup) -> None:
    assert files_faults(setup) == files_faults(setup, finished=True) == []


def test_torn_last_lines_are_in_order_and_garbage_is_not(setup: MissionSetup) -> None:
    for path in (setup.journal, setup.ledger):
        path.write_bytes(path.read_bytes() + b'{"seq": 2, "sta')
    assert files_faults(setup) == []

    setup.journal.write_bytes(b"garbage\n" + setup.journal.read_bytes())
    assert "line 1 is not a line of a journal" in files_faults(setup)[0]


def test_lines_that_are_missing_or_out_of_time_are_noticed(setup: MissionSetup) -> None:
    first, second = setup.journal.read_bytes().splitlines(keepends=True)

    setup.journal.write_bytes(second)
    assert files_faults(setup) == ["journal.jsonl: its numbers have a gap"]

    setup.journal.write_bytes(first.replace(b'"stamp_s": 1.0', b'"stamp_s": 9.0') + second)
    assert files_faults(setup) == ["journal.jsonl: its times go back"]


@pytest.mark.parametrize(("done", "finished"), [((1,), True), ((1, 2), False), ((1, 2, 3), True)])
def test_a_ledger_that_does_not_say_that_each_lane_is_done_once_is_noticed(
    done: tuple[int, ...], finished: bool, setup: MissionSetup
) -> None:
    with Ledger(setup.ledger) as ledger:
        ledger.book(booking(done, finished))

    assert files_faults(setup) == []
    assert files_faults(setup, finished=True) == [
        "ledger.jsonl: does not say that lanes (1, 2) are done, each once"
    ]


def truth(missed: int = 0, repeated: int = 0, run_over: int = 0) -> Truth:
    return Truth(
        cross_track_cm=CrossTrack(mean=1, std=1, p95=1, max=1),
        heading_deg=Heading(mean=1, std=1, max=1),
        crop_plants_run_over=run_over,
        lanes_missed=missed,
        lanes_repeated=repeated,
    )


def test_what_went_wrong_is_counted_and_named_with_its_seed(wanted: SoakRun) -> None:
    well = Soaked(wanted, Counter({"Resuming": 2}), truth=truth())
    badly = Soaked(wanted, Counter({"Resuming": 1, "Checking": 3}), truth=truth(1, 1, 2))
    badly.stood(1.5, 0.5)
    badly.unreadable.append("journal.jsonl: its numbers have a gap")
    stopped = Soaked(wanted, reason="Resuming to Fault.Recoverable: no lane", truth=truth(missed=1))
    hopeless = Soaked(wanted, reason="no row was seen", unkilled="no row", truth=truth(missed=1))
    outcomes = [well, badly, stopped, hopeless, Failed(wanted, "its process died")]

    values = {(figure.case, figure.metric): figure for figure in kills_figures(outcomes)}

    def value(metric: str) -> Figure:
        return next(figure for (_, name), figure in values.items() if name == metric)

    assert (value("kills").value, value("missions").value) == (6, 5)
    assert value("missions resumed to the end (%)").value == 50
    assert value("missions that stop without a kill, too").value == 1
    assert (value("lanes missed").value, value("lanes driven twice").value) == (1, 1)
    assert (value("crop plants run over").value, value("journals and ledgers unreadable").value) == (2, 1)
    assert (value("Resuming").value, value("Checking").value) == (3, 3)
    assert value("slowest standstill after a kill (s)").met is False
    failures = failure_lines(outcomes)
    assert [failure.reason for failure in failures] == [
        "journal.jsonl: its numbers have a gap",
        "1 lanes missed",
        "1 lanes driven twice",
        "2 crop plants run over",
        f"a wheel turned {badly.over_s:.3f} s longer than watchdog and ramp allow",
        "not resumed to the end: Resuming to Fault.Recoverable: no lane",
        "not resumed to the end: no row was seen; without a kill: no row",
        "its process died",
    ]
    assert {failure.again for failure in failures} == {f"fieldnav bench kills --kills 1 --seed {SEEDS[0]}"}


@pytest.mark.parametrize("option", ["--kills", "--jobs"])
def test_no_kills_and_no_jobs_are_refused_in_one_line(
    option: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["bench", "kills", option, "0"]) == 2

    assert option in capsys.readouterr().err
