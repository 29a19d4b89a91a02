"""`fieldnav check`: a line a check, with the figure and what to do; exit status 1 when one failed."""

import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Event, Thread

import cv2
import numpy as np
import pytest

from drivers.can_log import open_bus
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald_protocol import ModuleFlag
from fieldnav.cli.app import run
from fieldnav.messages import Wheel
from fieldnav.settings.loading import load_robot
from fieldnav.settings.robot import Robot

WIDTH_PX, HEIGHT_PX, RATE_HZ = 320, 192, 30.0
PICTURES, ROUNDS = 6, 40
"""Different pictures of a recording, and how often they come: longer than any machine pauses."""
STEP_S = 0.005
Findings = dict[str, tuple[str, str]]


def record(folder: Path, brightness: int) -> str:
    """A folder of pictures of coarse soil, each with its own grain."""
    folder.mkdir()
    for seed in range(PICTURES):
        grain = np.random.default_rng(seed + brightness).normal(brightness, 25, (HEIGHT_PX, WIDTH_PX, 3))
        first = folder / f"0-{seed}.png"
        cv2.imwrite(str(first), np.clip(grain, 0, 255).astype(np.uint8))
        for again in range(1, ROUNDS):
            (folder / f"{again:02}-{seed}.png").symlink_to(first)
    return str(folder)


class Bench:
    """A robot file whose bus is within this process and whose cameras are recordings."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self._folder, self._capsys = folder, capsys
        self.file = folder / "robot.yaml"
        self._document = load_robot("bonnbot").model_dump(mode="json")
        self._document["can"] = {"interface": "virtual", "channel": str(folder)}
        size = {"width_px": WIDTH_PX, "height_px": HEIGHT_PX, "rate_hz": RATE_HZ}
        for name, brightness in (("front", 90), ("rear", 140)):
            source = {"source": record(folder / name, brightness)}
            self._document["cameras"][name] |= size | source
        self.set()

    def set(self, **values: object) -> None:
        self._document |= values
        self.file.write_text(json.dumps(self._document))

    @property
    def robot(self) -> Robot:
        return Robot.model_validate(self._document, strict=False)

    def check(self, *more: str) -> tuple[int, Findings]:
        """The exit status, and each check's result and words."""
        out = ("--out", str(self._folder / "runs"))
        status = run(["check", "--robot", str(self.file), "--json", *out, *more])
        said = json.loads(self._capsys.readouterr().out)
        assert set(said) == {"ok", "checks"}
        assert said["ok"] is (status == 0)
        return status, {
            one["check"]: (one["result"], f"{one['figure']}; {one['advice']}") for one in said["checks"]
        }


@pytest.fixture
def bench(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Bench:
    return Bench(tmp_path, capsys)


@pytest.fixture
def modules(bench: Bench) -> Iterator[SimulatedModules]:
    """The modules at the far end of the bus, alive on the wall clock."""
    bus = open_bus(bench.robot.can)
    simulated, over = SimulatedModules(bench.robot, bus), Event()
    thread = Thread(target=live, args=(simulated.step, over))
    thread.start()
    yield simulated
    over.set()
    thread.join()
    bus.shutdown()


def live(step: Callable[[float], None], over: Event) -> None:
    while not over.wait(STEP_S):
        step(time.monotonic())


def test_a_robot_that_is_well_has_a_line_a_check_and_status_0(
    bench: Bench, modules: SimulatedModules, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    began_s = time.monotonic()
    status = run(["check", "--robot", str(bench.file), "--out", str(tmp_path / "runs")])
    took_s = time.monotonic() - began_s

    said = capsys.readouterr()
    assert (status, said.err) == (0, "")
    named = [line[9:33].strip() for line in said.out.splitlines()]
    opens = ["bus opens", "front camera opens", "rear camera opens"]
    computer = ["disk", "clock", "computer"]
    wheels = [f"module {wheel.value}" for wheel in Wheel]
    bus = ["bus frames", "bus errors", "other hosts", *wheels, "battery"]
    looked = ["frames", "picture", "lives", "sharpness"]
    cameras = [f"{name} camera {what}" for name in ("front", "rear") for what in looked]
    assert named == ["robot file", *opens, *computer, *bus, *cameras, "two cameras"]
    assert {line.split()[0] for line in said.out.splitlines()} <= {"ok", "warning"}
    assert took_s < 12
    assert not (tmp_path / "runs").exists(), "a check leaves nothing behind"


def test_a_module_with_a_fault_and_a_folder_that_cannot_be_written_fail_with_status_1(
    bench: Bench, modules: SimulatedModules, tmp_path: Path
) -> None:
    modules.modules[Wheel.REAR_LEFT].faults = ModuleFlag.STALL
    (tmp_path / "file").touch()

    status, found = bench.check("--out", str(tmp_path / "file"))

    assert status == 1
    assert {check for check, (result, _) in found.items() if result == "fail"} == {"module rear_left", "disk"}
    assert "stall" in found["module rear_left"][1]


def test_without_a_bus_the_cameras_are_still_looked_at_and_the_crop_too(bench: Bench) -> None:
    bench.set(can={"interface": "socketcan", "channel": "can-none"})

    status, found = bench.check("--crop", "sugar-beet")

    assert status == 1
    assert found["bus opens"][0] == "fail" and "channel can-none" in found["bus opens"][1]
    assert found["front camera frames"][0] == "ok"
    assert found["front camera rows"][0] == "warning"
    assert "module rear_left" not in found


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"timeouts": {"frame_s": -1}}, "timeouts.frame_s"),
        (
            {
                "modules": load_robot("bonnbot").model_dump(mode="json")["modules"]
                | {"rear_left": {"node_id": 9}}
            },
            "modules.rear_left.node_id: 9",
        ),
    ],
)
def test_a_wrong_robot_file_is_one_failed_check(bench: Bench, wrong: dict[str, object], words: str) -> None:
    bench.set(**wrong)

    status, found = bench.check()

    assert status == 2, "wrong input"
    assert list(found) == ["robot file"]
    assert found["robot file"][0] == "fail" and words in found["robot file"][1]


def test_a_crop_that_is_unknown_or_does_not_fit_fails_and_the_cameras_are_still_looked_at(
    bench: Bench,
) -> None:
    lost = {"interface": "socketcan", "channel": "can-none"}
    bench.set(can=lost)
    wrong, unknown = bench.check("--crop", "sugar-beat")
    bench.set(geometry=load_robot("bonnbot").geometry.model_dump() | {"clearance_m": 0.1})
    status, unfit = bench.check("--crop", "sugar-beet")

    assert wrong == 2, "wrong input"
    assert unknown["crop profile"][0] == "fail" and "sugar-beet" in unknown["crop profile"][1]
    assert unknown["front camera frames"][0] == "ok"
    assert status == 1
    assert unfit["crop fits robot"][0] == "fail" and "clearance_m 0.1" in unfit["crop fits robot"][1]


def test_a_robot_must_be_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check"]) == 2
    assert "--robot" in capsys.readouterr().err
