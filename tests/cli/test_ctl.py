"""`fieldnav ctl` does what it is told to a running mission, or says why not, in one line."""

import json
import os
import socket
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from fieldnav.cli.app import run
from fieldnav.operator.desk import Desk
from fieldnav.operator.request import Command, Request
from fieldnav.operator.socket_place import SocketPlace, socket_path
from fieldnav.operator.status import Status

OLD, NEW = "20260501T083000Z-bonnbot", "20260501T093000Z-thorvald"
ROUND_S = 0.002
COMMANDS = [command.value for command in Command]
STATUS = Status(
    run=OLD,
    state="Forward.Follow.Tracking",
    since_s=12.34,
    lane=2,
    lanes=3,
    rows=3,
    distance_m=34.56,
    speed_mps=0.5,
    warnings=("rear camera knocked",),
    battery_percent=81.0,
    lateness_s=0.0031,
)


class Mission:
    """A mission that only speaks with its operator: rounds in a thread, every request answered alike."""

    def __init__(self, desk: Desk, ok: bool) -> None:
        self.asked: list[Command] = []
        self._desk, self._ok = desk, ok
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._drive)
        self._thread.start()

    def end(self) -> None:
        self._over.set()
        self._thread.join()
        self._desk.close()

    def _drive(self) -> None:
        now_s = 0.0
        while not self._over.wait(ROUND_S):
            now_s += ROUND_S
            for request in self._desk.poll(now_s):
                self._obey(request)

    def _obey(self, request: Request) -> None:
        self.asked.append(request.command)
        if request.command is Command.STATUS:
            request.reply(self._ok, "here it is", STATUS)
        else:
            request.reply(self._ok, "paused in Forward.Exit" if self._ok else "nothing to pause in Idle")


Start = Callable[..., Mission]


@pytest.fixture(autouse=True)
def place(monkeypatch: pytest.MonkeyPatch) -> Iterator[SocketPlace]:
    """Folders for sockets that no other mission on this computer uses; short, as their paths must be."""
    with tempfile.TemporaryDirectory(prefix="fn") as folder:
        runtime = Path(folder) / "runtime"
        runtime.mkdir(mode=0o700)
        monkeypatch.setenv("XDG_RUNTIME_DIR", str(runtime))
        monkeypatch.setattr(tempfile, "tempdir", folder)
        yield SocketPlace()


@pytest.fixture
def start(place: SocketPlace) -> Iterator[Start]:
    with ExitStack() as stack:

        def begin(name: str = OLD, ok: bool = True, seen_from: SocketPlace = place) -> Mission:
            mission = Mission(Desk.open(name, seen_from), ok)
            stack.callback(mission.end)
            return mission

        yield begin


@pytest.mark.parametrize("command", COMMANDS)
def test_what_was_done_is_told_and_the_exit_status_is_0(
    command: str, start: Start, capsys: pytest.CaptureFixture[str]
) -> None:
    mission = start()
    assert run(["ctl", command]) == 0
    assert [asked.value for asked in mission.asked] == [command]
    if command != "status":
        assert capsys.readouterr().out == f"{OLD}: paused in Forward.Exit\n"


@pytest.mark.parametrize("command", COMMANDS)
def test_a_refusal_says_why_and_the_exit_status_is_1(
    command: str, start: Start, error: Callable[[], str]
) -> None:
    start(ok=False)
    assert run(["ctl", command]) == 1
    assert error().startswith(f"error: {OLD}: ")


@pytest.mark.parametrize("command", COMMANDS)
def test_without_a_mission_there_is_one_line_and_the_exit_status_2(
    command: str, error: Callable[[], str]
) -> None:
    assert run(["ctl", command]) == 2
    assert error() == "error: no mission is running; allowed is a run that `fieldnav run` drives now"


def test_the_status_is_a_small_table(start: Start, capsys: pytest.CaptureFixture[str]) -> None:
    start()
    assert run(["ctl", "status"]) == 0
    lines = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert [line for line in lines if line] == [
        OLD,
        "state Forward.Follow.Tracking for 12.3 s",
        "lane 2 of 3, rows 3",
        "distance 34.6 m",
        "speed 0.50 m/s",
        "battery 81 %",
        "loop 3.1 ms late at worst",
        "warning rear camera knocked",
    ]


def test_programs_get_one_json_object(start: Start, capsys: pytest.CaptureFixture[str]) -> None:
    start()
    assert run(["ctl", "status", "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert (answer["run"], answer["ok"], answer["said"]) == (OLD, True, "here it is")
    assert answer["status"]["state"] == "Forward.Follow.Tracking"
    assert answer["status"]["battery_percent"] == 81.0


def test_programs_get_a_refusal_as_json_too(start: Start, capsys: pytest.CaptureFixture[str]) -> None:
    start(ok=False)
    assert run(["ctl", "pause", "--json"]) == 1
    assert json.loads(capsys.readouterr().out) == {
        "run": OLD,
        "ok": False,
        "said": "nothing to pause in Idle",
        "status": None,
    }


def test_of_several_missions_only_the_named_one_is_spoken_to(start: Start, error: Callable[[], str]) -> None:
    old, new = start(OLD), start(NEW)
    assert run(["ctl", "pause"]) == 2
    assert error() == (
        f"error: several missions are running: {NEW}, {OLD}; name one with --run, or --run last"
    )
    assert run(["ctl", "pause", "--run", "bonnbot"]) == 0
    assert run(["ctl", "stop", "--run", "last"]) == 0
    assert (old.asked, new.asked) == ([Command.PAUSE], [Command.STOP])


def test_a_folder_of_runs_tells_several_missions_apart(start: Start, tmp_path: Path) -> None:
    old, new = start(OLD), start(NEW)
    (tmp_path / NEW).mkdir()
    (tmp_path / NEW / "journal.jsonl").touch()
    assert run(["ctl", "pause", "--runs", str(tmp_path)]) == 0
    assert (old.asked, new.asked) == ([], [Command.PAUSE])


def test_a_service_without_a_runtime_folder_is_found(start: Start, place: SocketPlace) -> None:
    service = start(seen_from=SocketPlace(place.user, place.temporary, {}))
    assert run(["ctl", "stop"]) == 0
    assert service.asked == [Command.STOP]


def test_what_a_killed_mission_has_left_is_no_mission(place: SocketPlace, error: Callable[[], str]) -> None:
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as dead:
        dead.bind(os.fspath(socket_path(place.make(), OLD)))
    assert run(["ctl", "status"]) == 2
    assert "no mission is running" in error()


def test_a_folder_that_cannot_be_trusted_is_told(place: SocketPlace, error: Callable[[], str]) -> None:
    place.make().chmod(0o777)
    assert run(["ctl", "status"]) == 2
    assert "mode 0777 lets others in; allowed is 0700" in error()


def test_a_mission_that_hangs_is_told_from_one_that_has_ended(
    place: SocketPlace, error: Callable[[], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fieldnav.operator.caller.ANSWER_S", 0.05)
    with Desk.open(OLD, place):  # nobody looks at it
        assert run(["ctl", "stop"]) == 2
    assert "gives no answer" in error()


def test_a_mission_that_ends_meanwhile_is_one_line(place: SocketPlace, error: Callable[[], str]) -> None:
    path = socket_path(place.make(), OLD)
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as ending:
        ending.bind(os.fspath(path))
        ending.listen()
        hanging_up = threading.Thread(target=_hang_up_on, args=(ending, 2))
        hanging_up.start()
        assert run(["ctl", "status"]) == 2
        hanging_up.join()
    assert error() == f"error: {OLD}: has ended without an answer"


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_reads_well(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["ctl", *([command] if command else []), "--help"]) == 0
    assert "Usage: fieldnav ctl" in capsys.readouterr().out


def _hang_up_on(listener: socket.socket, callers: int) -> None:
    for _ in range(callers):
        listener.accept()[0].close()
