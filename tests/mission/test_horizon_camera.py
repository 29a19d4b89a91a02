"""A robot whose cameras look obliquely, at ground up to near the horizon, driven by the normal command."""

import json
from importlib.resources import files
from pathlib import Path

import pytest

from fieldnav.cli.app import run as command
from fieldnav.journal.directory import find_run
from fieldnav.journal.journal import read
from fieldnav.settings.loading import load_robot

WELL_WITHIN_M = 0.03
QUARTER = {"width_px: 1280": "width_px: 320", "height_px: 720": "height_px: 180"}


def robot_file(tilt_deg: float, tmp_path: Path) -> Path:
    """Bonnbot with cameras of that tilt, and fewer pixels: quicker to draw and to look at."""
    text = (files("config") / "robots" / "bonnbot.yaml").read_text(encoding="utf-8")
    for old, new in (QUARTER | {"tilt_deg: 65": f"tilt_deg: {tilt_deg}"}).items():
        assert text.count(old) == 2
        text = text.replace(old, new)
    path = tmp_path / "looks-obliquely.yaml"
    path.write_text(text)
    return path


@pytest.mark.parametrize(("tilt_deg", "seed"), [(20, 1), (30, 2)])
def test_two_short_lanes_are_driven_whole(
    tilt_deg: float, seed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    robot, runs = robot_file(tilt_deg, tmp_path), tmp_path / "runs"
    options = ["--lanes", "2", "--length", "4", "--sketch", "--no-record", "--json", "--out", str(runs)]
    assert all(camera.top_px > 0 for camera in load_robot(str(robot)).cameras.pinholes().values())

    assert command(["simulate", "demo", "--robot", str(robot), "--seed", str(seed), *options]) == 0

    told = json.loads(capsys.readouterr().out)
    assert told["completed"] and told["lanes"] == {"done": 2, "total": 2} and not told["faults"]
    assert told["switches"] == {"attempted": 1, "succeeded": 1}
    assert told["truth"]["cross_track_cm"]["mean"] < 100 * WELL_WITHIN_M
    assert not told["truth"]["crop_plants_run_over"]
    assert "held by the gate" not in {line.event for line in read(find_run("last", runs).journal)}
