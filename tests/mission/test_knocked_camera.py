"""A camera that was knocked away from its file's values is told of while the robot follows the rows."""

from collections.abc import Iterator
from math import radians
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from fieldnav.cli.mission_report import report
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Line
from fieldnav.journal.journal import read
from fieldnav.journal.summary import Summary, read_summary
from fieldnav.messages import CameraName, Centres, Frame, Motion, Side, Twist
from fieldnav.mission.camera_watch import CameraWatch
from fieldnav.mission.simulated import Run, simulate
from fieldnav.mission.tick import Tick
from fieldnav.perception.canopy import canopy_plane
from fieldnav.pinhole import Pinhole
from fieldnav.settings.camera import CameraLimits
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.settings.robot import Robot
from states.behaviour import Sight, Step, Task
from states.names import Event
from states.table import LANE_LEAVES

CROP = load_crop("sugar-beet")
FILED = Pinhole(640, 360, 465.6, 1.0, radians(65), 0.75)
TRACKING = next(leaf for leaf in LANE_LEAVES if str(leaf[-1].value) == "Tracking")
ACQUIRING = next(leaf for leaf in LANE_LEAVES if str(leaf[-1].value) == "Acquiring")
KNOCKED_BY_DEG = 8.0
KNOCKING_SEED, KNOCKING_DRAW = 5, 0.917
"""A seed that draws nearly the whole of the front camera's tilt error, and what share of it."""


def quick_robot() -> Robot:
    return smaller(load_robot("bonnbot"), 4)


def drive(parent: Path, tilt_error_deg: float) -> tuple[RunDirectory, Summary, list[Tick]]:
    """One lane of beets; the front camera looks KNOCKING_DRAW of the tilt error lower than its file says."""
    errors = load_field("demo").camera_errors.model_dump() | {"tilt_error_deg": tilt_error_deg}
    changes = {"lanes": 1, "length_m": 8, "seed": KNOCKING_SEED, "camera_errors": errors}
    field = revised(load_field("demo"), changes)
    seen: list[Tick] = []

    class Watcher:
        def watch(self, tick: Tick) -> None:
            seen.append(tick)

    run = Run(field, load_crop(field.crop), quick_robot(), 1, Side.RIGHT, parent)
    done = simulate(run, [Watcher()])
    return done.directory, done.summary, seen


def knocks(directory: RunDirectory) -> list[Line]:
    return [line for line in read(directory.journal) if line.event == "camera knocked"]


@pytest.fixture(scope="module")
def knocked(tmp_path_factory: pytest.TempPathFactory) -> tuple[RunDirectory, Summary, list[Tick]]:
    return drive(tmp_path_factory.mktemp("runs"), KNOCKED_BY_DEG / KNOCKING_DRAW)


def test_a_knocked_camera_is_told_of_once_within_a_few_metres(
    knocked: tuple[RunDirectory, Summary, list[Tick]],
) -> None:
    directory, _, ticks = knocked

    (line,) = knocks(directory)

    assert line.source == line.target == "Forward.Follow.Tracking", "the state stays as it is"
    assert line.reason.startswith("front camera knocked: tilt 7")
    assert line.frame and line.frame["camera"] == "front"
    assert line.command and line.command["vx_mps"], "the wheels are told what they were told without it"
    following_m = [tick.forward_m for tick in ticks if tick.state == TRACKING]
    told_m = next(tick.forward_m for tick in ticks if tick.warning)
    assert told_m - following_m[0] < 5


def test_the_evidence_of_a_knock_names_every_value_with_its_limit(
    knocked: tuple[RunDirectory, Summary, list[Tick]],
) -> None:
    limits = CameraLimits()

    evidence = {judged.name: judged for judged in knocks(knocked[0])[0].evidence}

    assert [(each.threshold, each.unit) for each in evidence.values()] == [
        (limits.tilt_deg, "deg"),
        (limits.height_m, "m"),
        (limits.yaw_deg, "deg"),
    ]
    assert evidence["tilt off the file's"].value == pytest.approx(KNOCKED_BY_DEG, abs=3)


def test_the_summary_and_the_report_show_the_warning(
    knocked: tuple[RunDirectory, Summary, list[Tick]],
) -> None:
    directory, summary, _ = knocked
    console = Console(width=200)

    with console.capture() as captured:
        console.print(report(directory, summary))

    reason = knocks(directory)[0].reason
    assert summary.completed, "a knock is a warning, the mission goes on"
    assert summary.warnings == (reason,)
    assert read_summary(directory.summary) == summary
    assert reason in captured.get()


@pytest.mark.long  # over two shorter lanes in tests/test_mission.py
def test_calibration_errors_as_they_are_usual_give_no_warning(tmp_path: Path) -> None:
    directory, summary, _ = drive(tmp_path, load_field("demo").camera_errors.tilt_error_deg)

    assert knocks(directory) == []
    assert summary.warnings == ()
    assert "warnings" not in directory.summary.read_text()


def steps(true: Pinhole, camera: CameraName, seed: int = 1) -> Iterator[Step]:
    """What the robot sees every 0.1 m of a stand of beets, by a camera that looks as `true` does."""
    random = np.random.default_rng(seed)
    ahead = np.arange(0, 12, CROP.plants.spacing_m)
    stand = np.array([[x, place] for place in (0.35, 0.0, -0.35) for x in ahead])
    stand += random.normal(0, 0.01, stand.shape)
    filed, plane = canopy_plane(FILED, CROP), canopy_plane(true, CROP)
    rows = tuple(filed.row_in_image(place, 0.0) for place in (0.35, 0.0, -0.35))
    for sequence in range(80):
        position = plane.to_image(stand - [sequence * 0.1, 0])
        position = position[((position > 0) & (position < [640, 360])).all(axis=1)]
        area = (plane.pixels_per_metre(position[:, 1]) * CROP.plants.canopy_width_m) ** 2
        centres = Centres(position, area, position[:, 1], position[:, 1])
        frame = Frame(camera, sequence, sequence * 0.2, np.zeros((1, 1, 3), np.uint8))
        yield Step(Motion(Twist(vx_mps=0.5)), Event.LANE_ENDED, (), Sight(frame, rows, centres))


def watch() -> CameraWatch:
    task = Task(CROP, dict.fromkeys(CameraName, FILED), Side.RIGHT, lanes=1)
    return CameraWatch(task, CameraLimits())


def complaints(watching: CameraWatch, seen: Iterator[Step], backward: bool = False) -> list[Step]:
    told = []
    for index, step in enumerate(seen):
        found = watching.complaint(TRACKING, step, (-0.1 if backward else 0.1) * 1.001 * index)
        told += [found] if found else []
    return told


LOWERED = Pinhole(640, 360, 465.6, 1.0, radians(73), 0.75)


def test_each_camera_is_complained_of_once() -> None:
    watching = watch()

    front = complaints(watching, steps(LOWERED, CameraName.FRONT))
    again = complaints(watching, steps(LOWERED, CameraName.FRONT))
    rear = complaints(watching, steps(LOWERED, CameraName.REAR), backward=True)

    assert [len(front), len(again), len(rear)] == [1, 0, 1]
    assert rear[0].reason.startswith("rear camera knocked")


def test_a_complaint_changes_no_state_and_keeps_the_motion() -> None:
    (told,) = complaints(watch(), steps(LOWERED, CameraName.FRONT))

    assert told.event is None
    assert told.motion.twist == Twist(vx_mps=0.5)


def test_what_is_seen_outside_tracking_or_standing_still_does_not_count() -> None:
    acquiring, standing = watch(), watch()

    outside = [
        acquiring.complaint(ACQUIRING, step, 0.1 * index)
        for index, step in enumerate(steps(LOWERED, CameraName.FRONT))
    ]
    still = [standing.complaint(TRACKING, step, 3.0) for step in steps(LOWERED, CameraName.FRONT)]

    assert not any(outside)
    assert not any(still), "eighty looks at the same plants are one"


def test_a_tick_without_a_new_frame_is_nothing() -> None:
    assert watch().complaint(TRACKING, Step(), 1.0) is None
