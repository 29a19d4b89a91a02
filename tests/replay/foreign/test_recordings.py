"""The same drive, recorded in every way there is, leads to the same transitions."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin

from fieldnav.messages import CameraName, Direction

ALIKE_S = 4 / 15
"""Four frames: recordings differ in how much their compression loses."""
BOTH = {"front": "/front/image_raw", "rear": "/rear/image_raw/compressed"}
FOLLOWED = ["start", "ready", "rows found", "lane ended", "last lane left"]
OFF_M = 0.02
"""Of the mean offset: what the perception may be off on such small pictures."""

Replayed = Callable[..., dict[str, Any]]


def changes(done: dict[str, Any]) -> list[tuple[str, float]]:
    """Event and second of each transition that matters: at the end of a lane its rows are lost, too.

    Which of the two is certain first is a matter of one frame.
    """
    return [
        (line["event"], line["stamp_s"])
        for line in done["transitions"]
        if line["source"] != line["target"] and line["event"] != "rows lost"
    ]


@pytest.fixture(scope="module")
def of_ros_1(keeping: Any) -> dict[str, Any]:
    """A bag of ROS 1, replayed once: what the other kinds are compared with."""
    done: dict[str, Any] = json.loads(keeping(lambda recordings: recordings.bag1(), as_json=True).said)
    return done


def test_a_bag_of_ros_1_is_driven_to_the_end_of_its_lane(of_ros_1: dict[str, Any], drive: Any) -> None:
    done = of_ros_1

    assert [event for event, _ in changes(done)] == FOLLOWED
    assert done["summary"]["completed"]
    assert done["seen"]["share"] > 0.8
    assert done["seen"]["offset_m"] == pytest.approx(drive.offset_m, abs=OFF_M)


# An MCAP of ROS 2 is replayed in the next test as well, a folder of pictures further below.
@pytest.mark.parametrize("kind", ["sqlite3", pytest.param("mcap", marks=pytest.mark.long), "foxglove"])
def test_every_kind_of_bag_gives_the_transitions_of_ros_1(
    kind: str, recordings: Any, replayed: Replayed, of_ros_1: dict[str, Any]
) -> None:
    written = {
        "sqlite3": lambda: recordings.bag2(StoragePlugin.SQLITE3),
        "mcap": lambda: recordings.bag2(StoragePlugin.MCAP),
        "foxglove": recordings.mcap,
    }
    expected = changes(of_ros_1)

    found = changes(replayed(written[kind](), **BOTH))

    assert [event for event, _ in found] == [event for event, _ in expected]
    for (_, at_s), (_, expected_s) in zip(found, expected, strict=True):
        assert at_s == pytest.approx(expected_s, abs=ALIKE_S)


def test_an_mcap_of_ros_2_is_read_without_its_metadata(recordings: Any, replayed: Replayed) -> None:
    folder = recordings.bag2(StoragePlugin.MCAP)

    done = replayed(f"{folder}/drive_mcap.mcap", **BOTH)

    assert [event for event, _ in changes(done)] == FOLLOWED


@pytest.mark.parametrize("kind", ["video", pytest.param("folder", marks=pytest.mark.long)])
def test_videos_and_folders_give_the_transitions_of_a_bag(
    kind: str, recordings: Any, replayed: Replayed, of_ros_1: dict[str, Any]
) -> None:
    expected = changes(of_ros_1)
    write = getattr(recordings, kind)
    rate_hz = recordings.rate_hz if kind == "folder" else None

    done = replayed(write(), rear=write(CameraName.REAR), rate_hz=rate_hz)

    found = changes(done)
    assert [event for event, _ in found] == [event for event, _ in expected]
    for (_, at_s), (_, expected_s) in zip(found, expected, strict=True):
        assert at_s == pytest.approx(expected_s, abs=ALIKE_S)


def test_odometry_stands_for_the_assumed_speed(
    recordings: Any, replayed: Replayed, of_ros_1: dict[str, Any]
) -> None:
    expected = changes(of_ros_1)

    done = replayed(recordings.bag1(), **BOTH, odometry=recordings.odometry, speed_mps=1.5)

    found = changes(done)
    assert [event for event, _ in found] == [event for event, _ in expected]
    for (_, at_s), (_, expected_s) in zip(found, expected, strict=True):
        assert at_s == pytest.approx(expected_s, abs=ALIKE_S)


def test_backward_the_rear_camera_leads(recordings: Any, drive: Any, replayed: Replayed) -> None:
    """A robot that is turned round and drives backward gives the same pictures by the other cameras."""
    turned = {"front": BOTH["rear"], "rear": BOTH["front"]}

    done = replayed(recordings.bag1(), **turned, direction=Direction.BACKWARD)

    assert [event for event, _ in changes(done)] == FOLLOWED
    assert done["transitions"][2]["target"] == "Backward.Follow.Tracking"
    assert done["seen"]["offset_m"] == pytest.approx(drive.offset_m, abs=OFF_M)


def test_without_a_rear_camera_the_exit_says_that_it_lacks(recordings: Any, replayed: Replayed) -> None:
    done = replayed(recordings.mcap(), status=1, front=BOTH["front"])

    last = done["transitions"][-1]
    assert last["event"] == "fail" and last["source"] == "Forward.Exit"
    assert "the recording has no rear camera" in last["reason"]
    assert not done["summary"]["completed"]
    assert any("after the mission had stopped (see --again)" in note for note in done["notes"])


def test_the_end_of_the_recording_ends_the_run(recordings: Any, replayed: Replayed, drive: Any) -> None:
    done = replayed(recordings.folder(), rate_hz=60.0, speed_mps=2.0)

    last = done["transitions"][-1]
    assert last["reason"] == "the recording ends here"


def test_after_a_stop_it_begins_again_where_that_is_asked(recordings: Any, replayed: Replayed) -> None:
    done = replayed(recordings.mcap(), front=BOTH["front"], again=True)

    events = [line["event"] for line in done["transitions"]]
    assert events.count("start") > 1 and "reset" in events
    assert done["transitions"][-1]["reason"] == "the recording ends here"


@pytest.mark.parametrize(
    ("speed_mps", "share"), [pytest.param(0.3, 5 / 3, marks=pytest.mark.long), (0.5, 1.0), (0.7, 5 / 7)]
)
def test_pictures_tell_when_the_assumed_speed_is_off(
    speed_mps: float, share: float, recordings: Any, replayed: Replayed
) -> None:
    done = replayed(recordings.mcap(), **BOTH, speed_mps=speed_mps)

    assert done["ground_share"] == pytest.approx(share, rel=0.09)  # plants stand up from the ground
    hint = [note for note in done["notes"] if note.startswith("by the pictures the ground moves at")]
    assert [note.split("; ")[-1] for note in hint] == (
        [] if speed_mps == 0.5 else [f"--speed {done['ground_share'] * speed_mps:.2f} would fit"]
    )


def test_pictures_that_do_not_move_are_told(drive: Any, replayed: Replayed, tmp_path: Path) -> None:
    folder = tmp_path / "standing"
    folder.mkdir()
    picture, random = drive.of(CameraName.FRONT)[60].image, np.random.default_rng(1)
    for number in range(90):
        noise = random.integers(0, 3, picture.shape, np.uint8)  # without any a camera is frozen
        cv2.imwrite(str(folder / f"{number}.png"), picture + noise)

    done = replayed(str(folder), rate_hz=15.0, status=1)

    reason = done["transitions"][-1]["reason"]
    assert reason.startswith("camera shows the past: front camera: ")
