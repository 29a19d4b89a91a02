"""A run in figures, and everything that was in force."""

import json
from pathlib import Path

import pytest
import yaml

from fieldnav import __version__
from fieldnav.errors import FieldnavError, OutputError
from fieldnav.journal.resolved import write_settings
from fieldnav.journal.summary import (
    CrossTrack,
    Heading,
    Headland,
    Lanes,
    Summary,
    Switches,
    Truth,
    read_summary,
    write_summary,
)
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_crop, load_field, load_robot, parse
from fieldnav.settings.robot import Robot

SUMMARY = Summary(
    completed=True,
    lanes=Lanes(done=3, total=3),
    distance_m=40.5,
    duration_s=120.0,
    wall_s=30.0,
    realtime_factor=4.0,
    transitions=17,
    faults=0,
    switches=Switches(attempted=2, succeeded=2),
    headland_m=Headland(mean=float("nan"), max=0.5),
)
TRUTH = Truth(
    cross_track_cm=CrossTrack(mean=0.9, std=0.6, p95=1.9, max=2.4),
    heading_deg=Heading(mean=0.5, std=0.4, max=1.6),
    crop_plants_run_over=0,
    lanes_missed=0,
    lanes_repeated=0,
)


def test_a_summary_holds_what_the_design_lists_and_truth_in_simulation_only(tmp_path: Path) -> None:
    write_summary(tmp_path / "real.json", SUMMARY)
    write_summary(tmp_path / "simulated.json", SUMMARY.model_copy(update={"truth": TRUTH}))

    real = json.loads((tmp_path / "real.json").read_text())
    simulated = json.loads((tmp_path / "simulated.json").read_text())
    listed = (
        "completed lanes distance_m duration_s wall_s realtime_factor transitions faults switches headland_m"
    )
    assert list(real) == listed.split()
    assert list(simulated) == [*listed.split(), "truth"]
    assert list(simulated["truth"]["cross_track_cm"]) == ["mean", "std", "p95", "max"]
    assert real["headland_m"] == {"mean": None, "max": 0.5}


def test_a_summary_is_read_back_and_a_missing_one_is_none(tmp_path: Path) -> None:
    full = SUMMARY.model_copy(update={"truth": TRUTH, "headland_m": Headland(mean=0.4, max=0.5)})
    write_summary(tmp_path / "summary.json", full)

    assert read_summary(tmp_path / "summary.json") == full
    assert read_summary(tmp_path / "nowhere.json") is None


def test_a_summary_that_is_none_is_named(tmp_path: Path) -> None:
    (tmp_path / "summary.json").write_text("{}")

    with pytest.raises(FieldnavError, match="is not the summary of a run"):
        read_summary(tmp_path / "summary.json")


def test_a_summary_that_cannot_be_written_leaves_nothing_half_written(tmp_path: Path) -> None:
    (tmp_path / "summary.json").mkdir()

    with pytest.raises(OutputError, match="cannot be written"):
        write_summary(tmp_path / "summary.json", SUMMARY)

    assert [path.name for path in tmp_path.iterdir()] == ["summary.json"]


def test_the_settings_of_a_run_can_be_loaded_again_and_name_the_version(tmp_path: Path) -> None:
    crop, robot, field = load_crop("maize"), load_robot("thorvald"), load_field("sim-large-gaps")

    write_settings(tmp_path / "settings.yaml", crop, robot, field, {"lanes": 2, "side": "left"})

    document = yaml.safe_load((tmp_path / "settings.yaml").read_text())
    assert document["fieldnav"] == __version__
    assert document["options"] == {"lanes": 2, "side": "left"}
    assert parse(CropProfile, yaml.safe_dump(document["crop"]), "crop") == crop
    assert parse(Robot, yaml.safe_dump(document["robot"]), "robot") == robot
    assert parse(FieldSettings, yaml.safe_dump(document["field"]), "field") == field
