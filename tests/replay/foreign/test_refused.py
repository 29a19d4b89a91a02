"""Recordings that cannot be replayed: one line each, and no run directory where nothing was driven."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

import pytest

from fieldnav.cli.replay_foreign import Foreign, is_foreign, refuse_for_run, replay_foreign
from fieldnav.cli.replay_foreign_opening import opened
from fieldnav.errors import SettingsError
from fieldnav.journal.journal import read
from fieldnav.messages import CameraName
from fieldnav.replay.foreign.topics import image_topics
from fieldnav.settings.loading import load_robot

Asked = Callable[..., Foreign]
FRONT = {"front": "/front/image_raw"}


def refused(source: str, asked: Foreign) -> str:
    """The one line that is said."""
    with pytest.raises(SettingsError) as refusal:
        replay_foreign(source, asked, as_json=True)
    line = str(refusal.value)
    assert "\n" not in line
    return line


def test_a_wrong_topic_is_answered_with_those_that_hold_pictures(recordings: Any, asked: Asked) -> None:
    bag = recordings.bag1()

    line = refused(bag, asked(front="/front/image"))

    assert line.startswith(f"{bag}: --front /front/image: is not there; allowed are /front/image_raw (")
    assert "/rear/image_raw/compressed (sensor_msgs/msg/CompressedImage)" in line
    assert "/odom" not in line


def test_a_topic_without_pictures_is_said_to_hold_something_else(recordings: Any, asked: Asked) -> None:
    line = refused(recordings.bag2(), asked(front=recordings.odometry))

    assert "--front /odom: holds nav_msgs/msg/Odometry; allowed are /front/image_raw" in line


def test_of_two_topics_with_pictures_one_must_be_named(recordings: Any, asked: Asked) -> None:
    line = refused(recordings.mcap(), asked())

    assert "no topic is named; allowed are /front/image_raw (foxglove.CompressedImage), /rear" in line


def test_topics_that_nobody_named_are_told_and_a_file_without_pictures_lists_what_it_holds(
    recordings: Any, asked: Asked
) -> None:
    source = recordings.mcap()

    notes = opened(source, asked(**FRONT), load_robot("bonnbot")).notes

    assert notes[0].startswith("not looked at: /rear/image_raw/compressed, ")
    with pytest.raises(
        SettingsError, match=r"it holds no topic with pictures; .*; it holds /odom \(nav_msgs"
    ):
        image_topics(NoPictures(), {}, CameraName.FRONT)


class NoPictures:
    """A container of odometry alone."""

    name, seconds = "odometry.bag", 1.0
    topics: ClassVar = {"/odom": "nav_msgs/msg/Odometry"}
    counts: ClassVar = {"/odom": 7}

    def read(self, topic: str) -> Any:
        raise AssertionError("nobody reads it")


def test_the_leading_camera_may_not_be_left_out(recordings: Any, asked: Asked) -> None:
    line = refused(recordings.mcap(), asked(rear="/rear/image_raw/compressed"))

    assert "--front: is not given, and that camera leads" in line


def test_a_topic_that_tells_no_odometry(recordings: Any, asked: Asked) -> None:
    line = refused(recordings.bag1(), asked(**FRONT, odometry="/front/image_raw"))

    assert "--odometry /front/image_raw: is no odometry; allowed are /odom" in line


@pytest.mark.parametrize("write", ["bag1", "bag2"])
def test_without_the_extra_it_is_said_how_to_install_it(
    write: str, recordings: Any, asked: Asked, monkeypatch: pytest.MonkeyPatch
) -> None:
    bag = getattr(recordings, write)()
    monkeypatch.setitem(sys.modules, "rosbags", None)

    assert "pip install 'fieldnav[bags]'" in refused(bag, asked(**FRONT))


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9])
def test_a_truncated_bag_is_no_traceback(share: float, recordings: Any, asked: Asked, tmp_path: Path) -> None:
    for whole in (recordings.bag1(), f"{recordings.bag2()}/drive_sqlite3.db3", recordings.mcap()):
        cut = tmp_path / f"cut{Path(whole).suffix}"
        content = Path(whole).read_bytes()
        cut.write_bytes(content[: int(share * len(content))])

        line = refused(str(cut), asked(**FRONT))

        assert line.startswith(f"{cut}: ") and "allowed" in line
        cut.unlink()
    assert all("replay-cut" in run.name for run in (tmp_path / "runs").glob("*"))


def test_what_was_driven_before_a_file_breaks_is_kept(recordings: Any, asked: Asked, tmp_path: Path) -> None:
    folder = Path(recordings.folder())
    (folder / "90.jpg").write_bytes(b"no picture")

    line = refused(str(folder), asked(rate_hz=15.0))

    assert "90.jpg" in line and "pictures replayed until then: 90 of" in line
    (run,) = (tmp_path / "runs").iterdir()
    last = read(run / "journal.jsonl")[-1]
    assert last.event == "fail" and "90.jpg" in last.reason and last.stamp_s == pytest.approx(6.0, abs=0.1)
    assert (run / "summary.json").exists()


def test_an_empty_folder(asked: Asked, tmp_path: Path) -> None:
    empty = tmp_path / "empty"
    empty.mkdir()

    assert refused(str(empty), asked(rate_hz=15.0)).startswith(f"{empty}: holds no picture")


def test_a_folder_wants_a_rate_and_a_bag_none(recordings: Any, asked: Asked) -> None:
    assert "--rate 15" in refused(recordings.folder(), asked())
    assert "--rate: " in refused(recordings.bag1(), asked(**FRONT, rate_hz=15.0))


def test_a_video_has_no_topics(recordings: Any, asked: Asked) -> None:
    assert "has no topics" in refused(recordings.video(), asked(**FRONT))


def test_another_shape_of_picture_is_refused(recordings: Any, asked: Asked, tmp_path: Path) -> None:
    line = refused(recordings.bag1(), asked(**FRONT, changes=["robot.cameras.front.height_px=240"]))

    assert (
        "is 320x180 px; allowed is the 320x240 px of the robot file, or another size of the same shape"
        in line
    )
    assert not (tmp_path / "runs").exists()


def test_grey_pictures_are_refused(recordings: Any, asked: Asked) -> None:
    line = refused(recordings.bag1(encoding="mono8"), asked(**FRONT))

    assert "/front/image_raw: encoding mono8: is not in colour, or not known; allowed are bgr8, rgb8" in line


def test_a_crop_must_be_named(recordings: Any, asked: Asked) -> None:
    assert refused(recordings.bag1(), asked(**FRONT, crop=None)).startswith("--crop: is not given")


def test_a_run_of_ours_wants_none_of_the_options(quick_robot_file: Path, asked: Asked) -> None:
    refuse_for_run("last", asked(robot=None, speed_mps=None))

    with pytest.raises(SettingsError, match=r"^--robot, --rate: last is a run of fieldnav's"):
        refuse_for_run("last", asked(robot=str(quick_robot_file), speed_mps=None, rate_hz=15.0))


def test_a_run_is_not_foreign_and_a_name_neither(recordings: Any, tmp_path: Path) -> None:
    run = tmp_path / "run"
    run.mkdir()
    (run / "journal.jsonl").touch()

    assert is_foreign(recordings.mcap())
    assert not is_foreign(str(run)) and not is_foreign("last") and not is_foreign("a\0b")
