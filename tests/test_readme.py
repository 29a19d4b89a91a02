"""The README tells the truth: every command in it runs, and its diagram is the machine's."""

import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

from fieldnav.cli.app import run
from states.diagram import mermaid

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
SHORT = {"--lanes": "1", "--length": "4"}
"""Simulations are run as written, only on a shorter field; sketched ones are short."""
FAILS = "status 1"
"""What the comment of a command says that does not succeed, and should not."""


def lines() -> list[str]:
    """Every line of the README's shell blocks."""
    return "".join(re.findall(r"```sh\n(.*?)```", README, re.DOTALL)).splitlines()


def commands() -> list[list[str]]:
    """Every command in them, comments left out."""
    return [command for command in (shlex.split(line, comments=True) for line in lines()) if command]


def ours(program: str) -> list[list[str]]:
    return [command[1:] for command in commands() if command[0] == program]


def of_a_robot(arguments: list[str]) -> bool:
    """Whether a command needs a robot, or serves one until it is told to end; see tests/two_processes."""
    return arguments[0] in ("check", "run", "ctl") or "--serve" in arguments


def shortened(arguments: list[str], robot: Path) -> list[str]:
    """A simulation on a shorter field, by a robot with small cameras: what replays it costs less, too."""
    kept = [*arguments, "--robot", str(robot)]
    if "--sketch" in arguments:
        return kept
    for option, value in SHORT.items():
        if option in kept:
            kept[kept.index(option) + 1] = value
        else:
            kept += [option, value]
    return kept


def test_every_command_is_of_a_program_the_test_knows() -> None:
    assert {command[0] for command in commands()} == {"make", "fieldnav"}


@pytest.mark.parametrize("arguments", ours("make"), ids=" ".join)
def test_make_targets_exist(arguments: list[str]) -> None:
    done = subprocess.run(["make", "--dry-run", *arguments], cwd=ROOT, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr


def test_every_fieldnav_command_runs_in_the_readmes_order(
    tmp_path: Path,
    quick_robot_file: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for folder in ("config", "docs"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    monkeypatch.chdir(tmp_path)
    failing = [shlex.split(line, comments=True)[1:] for line in lines() if FAILS in line]
    for arguments in ours("fieldnav"):
        called = shortened(arguments, quick_robot_file) if arguments[0] == "simulate" else arguments
        if of_a_robot(arguments):
            called = [*arguments, "--help"]  # which still refuses an option that there is not
        status = run(called)
        said = capsys.readouterr()
        assert status == (1 if arguments in failing else 0), (arguments, said.err)
        assert said.out.strip() or "--out" in arguments, arguments
        if arguments == ["log", "why"]:
            assert the_cause(said.out) == the_cause(README)


def the_cause(text: str) -> str:
    """Of what `log why` prints, why the mission stopped; its figures may differ in the last digit."""
    found = re.search(r"^stopped at .*?: (what was found [^(]*)", text, re.MULTILINE)
    assert found, text
    return " ".join(found.group(1).split())


def test_the_state_diagram_is_the_machines() -> None:
    block = re.search(r"```mermaid\n(.*?)```", README, re.DOTALL)
    assert block, "the README shows the states"
    assert block.group(1).strip() == mermaid().strip()


def test_every_picture_and_link_is_there() -> None:
    for target in re.findall(r"\]\(([^)#]+)\)", README):
        if "://" not in target:
            assert (ROOT / target).exists(), target
