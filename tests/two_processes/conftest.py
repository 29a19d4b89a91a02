"""A served robot in one process, `fieldnav run` in another, and a listener on the bus between them."""

import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import can
import pytest
import yaml

from drivers.module_units import speed_from_rpm
from drivers.thorvald_protocol import Kind
from drivers.wire_layout import wire_layout
from fieldnav.journal.directory import runs_in
from fieldnav.journal.entry import Line
from fieldnav.journal.journal import read
from fieldnav.settings.loading import load_robot
from fieldnav.settings.robot import Module

LIMIT_S = 180.0
"""A bound for anything on a busy machine, not an expectation."""
STANDING_MPS = 0.005

Process = subprocess.Popen[str]


@dataclass
class Wire:
    """Listens to the modules as a second member of the bus."""

    bus: can.BusABC

    def fastest_mps(self, during_s: float) -> float:
        """The fastest that any wheel reports from now on, for so long."""
        until, fastest = time.monotonic() + during_s, 0.0
        while time.monotonic() < until:
            fastest = max(fastest, self._speed_mps(self.bus.recv(timeout=0.05)))
        return fastest

    def standing_within(self, limit_s: float) -> float:
        """How long it takes from now until all wheels have stood for a while; fails after the limit."""
        self._drain()
        began = time.monotonic()
        moved = began
        while time.monotonic() - moved < 0.3:
            if self._speed_mps(self.bus.recv(timeout=0.05)) > STANDING_MPS:
                moved = time.monotonic()
            assert time.monotonic() - began < limit_s, "the wheels go on turning"
        return moved - began

    def command(self, node: int, per_mille: int) -> None:
        """Command a wheel as a remote would."""
        values = {"Sequence": 7, "DriveSpeed": per_mille}
        self.bus.send(wire_layout().frame(0.0, node, Kind.DRIVE, values))

    def _drain(self) -> None:
        while self.bus.recv(timeout=0) is not None:
            pass

    def _speed_mps(self, frame: can.Message | None) -> float:
        telegram = wire_layout().read(frame) if frame is not None else None
        if telegram is None or telegram.kind is not Kind.MOTION:
            return 0.0
        return abs(speed_from_rpm(Module(node_id=telegram.node), telegram.values["DriveMotorSpeed"]))


@dataclass
class Scene:
    """The folder of a test, its processes, and the wire."""

    folder: Path
    wire: Wire
    server: Process
    begin: Callable[..., Process]

    def run(self, *options: str) -> Process:
        """`fieldnav run` on the served robot."""
        return self.begin("run", "--out", "runs", *options)

    def new_run(self, *options: str) -> Process:
        return self.run("--robot", "robot.yaml", "--crop", "sugar-beet", "--lanes", "2", *options)

    def ctl(self, *words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "fieldnav", "ctl", *words, "--runs", str(self.folder / "runs")],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=LIMIT_S,
            check=False,
        )

    @property
    def lines(self) -> list[Line]:
        runs = runs_in(self.folder / "runs")
        return read(runs[0].journal) if runs else []

    def await_line(self, wanted: Callable[[Line], bool], process: Process) -> None:
        """Wait until the newest line of the journal is as wanted."""
        until = time.monotonic() + LIMIT_S
        while not (self.lines and wanted(self.lines[-1])):
            assert process.poll() is None, f"the run goes on: {process.communicate()}"
            assert time.monotonic() < until, self.lines[-1:]
            time.sleep(0.05)

    def end_server(self) -> dict[str, object]:
        """What the robot truly did."""
        self.server.terminate()
        said, _ = self.server.communicate(timeout=LIMIT_S)
        return json.loads(said.splitlines()[-1])


@pytest.fixture
def scene(tmp_path: Path) -> Iterator[Scene]:
    """A sketched field of two short lanes with small, quick cameras."""
    began: list[Process] = []

    def begin(*arguments: str) -> Process:
        command = [sys.executable, "-m", "fieldnav", *arguments]
        began.append(
            subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        )
        return began[-1]

    _write_robot(tmp_path / "small.yaml", load_bonnbot())
    server = begin(
        *("simulate", "demo", "--serve", "--sketch", "--lanes", "2", "--length", "4", "--json"),
        *("--robot", "small.yaml", "--robot-file", "robot.yaml"),
    )
    offered = json.loads(server.stdout.readline())
    can_settings = offered["can"]
    bus = can.Bus(
        interface=can_settings["interface"],
        channel=can_settings["channel"],
        ignore_config=True,
        **can_settings["options"],
    )
    yield Scene(tmp_path, Wire(bus), server, begin)
    bus.shutdown()
    for process in began:
        process.kill()
        process.communicate()


def load_bonnbot() -> dict[str, object]:
    return load_robot("bonnbot").model_dump(mode="json")


def _write_robot(path: Path, robot: dict[str, object]) -> None:
    """Half-size pictures, and deadlines that a machine shared with other tests can keep."""
    for camera in robot["cameras"].values():
        camera["width_px"], camera["height_px"] = 640, 360
    robot["timeouts"] |= {"loop_s": 1.0, "motion_s": 1.0, "frame_s": 1.0}
    path.write_text(yaml.safe_dump(robot), encoding="utf-8")
