"""The robot file that a served robot is driven by."""

import stat
from pathlib import Path

import pytest

from fieldnav.errors import OutputError
from fieldnav.messages import CameraName
from fieldnav.settings.loading import load_robot
from fieldnav.simulation.served.robot_file import reached_at, write_robot_file

SOURCES = {name: f"http://127.0.0.1:5001/{name.value}.mjpg" for name in CameraName}


def test_the_file_names_the_same_machine_at_its_new_addresses(tmp_path: Path) -> None:
    path, machine = tmp_path / "served.yaml", load_robot("bonnbot")

    write_robot_file(path, reached_at(machine, "can0", ("127.0.0.1", 5000), SOURCES, latency_s=0.12))
    robot = load_robot(path)

    assert (robot.can.interface, robot.can.channel) == ("socketcand", "can0")
    assert robot.can.options == {"host": "127.0.0.1", "port": 5000}
    for name in CameraName:
        camera = robot.cameras.get(name)
        assert (camera.source, camera.latency_s) == (SOURCES[name], 0.12)
    unchanged = {"can": machine.can, "cameras": machine.cameras}
    assert robot.model_copy(update=unchanged) == machine


def test_the_file_is_its_owners_alone_and_takes_the_place_of_an_older_one(tmp_path: Path) -> None:
    path = tmp_path / "served.yaml"
    path.write_text("old")

    write_robot_file(path, load_robot("thorvald"))

    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert load_robot(path) == load_robot("thorvald")
    assert list(tmp_path.iterdir()) == [path]


def test_a_place_that_cannot_be_written_is_one_clear_line(tmp_path: Path) -> None:
    (tmp_path / "folder.yaml").mkdir()

    for path, said in (
        (tmp_path / "no" / "r.yaml", "No such file"),
        (tmp_path / "folder.yaml", "is a folder"),
    ):
        with pytest.raises(OutputError, match=f"^{path}: cannot be written: .*{said}"):
            write_robot_file(path, load_robot("bonnbot"))
    assert [entry.name for entry in tmp_path.iterdir()] == ["folder.yaml"]
