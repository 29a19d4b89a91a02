"""Stamps that jump, step back, lack or stand still: each picture is looked at, or it is said how many not."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from fieldnav.errors import SettingsError
from fieldnav.messages import CameraName
from fieldnav.mission.loop import TICK_S
from fieldnav.replay.foreign.camera import ForeignCamera
from fieldnav.replay.foreign.container import Written, stamped
from fieldnav.replay.foreign.left_out import LeftOut
from fieldnav.replay.foreign.shot import NS_PER_S, Shot
from fieldnav.replay.foreign.steps import LOOK_AHEAD, in_order, long
from fieldnav.replay.foreign.timeline import Timeline
from fieldnav.settings.loading import load_robot

Clocks = Callable[[CameraName, int, int], tuple[int, int]]
Replayed = Callable[..., dict[str, Any]]
FRONT, BOTH = (
    {"front": "/front/image_raw"},
    {"front": "/front/image_raw", "rear": "/rear/image_raw/compressed"},
)
HOUR_NS, YEAR_NS = 3600 * NS_PER_S, 31_557_600 * NS_PER_S
SHORT = slice(30)
"""Of the pictures of both cameras: 15 of each, a second, in which the lane does not end."""
STEP_AT = 5
FRAME_NS = NS_PER_S // 15
BEGUN_NS = 1_750_000_000 * NS_PER_S


def header_jumps(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
    """Since switch-on until the clock is set; the computer that writes has the right time all along."""
    return at_ns - 53 * YEAR_NS if number <= STEP_AT else at_ns, at_ns


def both_jump(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
    shifted = at_ns + (HOUR_NS if number > STEP_AT else 0)
    return shifted, shifted


def header_steps_back(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
    return at_ns - (HOUR_NS if number > STEP_AT else 0), at_ns


def both_step_back(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
    shifted = at_ns - (2 * NS_PER_S if number > STEP_AT else 0)
    return shifted, shifted


@pytest.mark.parametrize(
    ("clocks", "again", "said"),
    [
        (header_jumps, False, "jump by 53 years after picture 5"),
        (both_jump, True, "jump by 1 hour after picture 5"),
        (both_step_back, False, "step back by 1.9 seconds after picture 5"),
    ],
)
def test_a_step_is_told_and_skipped_and_the_mission_begun_anew_behind_it(
    clocks: Clocks, again: bool, said: str, recordings: Any, replayed: Replayed
) -> None:
    done = replayed(recordings.mcap(clocks, SHORT), **FRONT, again=again)

    assert f"front camera: the stamps {said}" in done["notes"]
    reasons = [line["reason"] for line in done["transitions"]]
    assert reasons.count("begun anew behind the step in the stamps") == 1 and len(reasons) < 20
    assert done["pictures"]["front"]["taken"] == 15 and done["pictures"]["front"]["not_looked_at"] == 0
    assert done["seen"]["frames"] >= 13 and done["summary"]["duration_s"] < 1.5


def test_again_waits_for_a_picture(recordings: Any, replayed: Replayed) -> None:
    def silent(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
        return at_ns + (number > STEP_AT) * 5 * NS_PER_S, at_ns

    done = replayed(recordings.mcap(silent, SHORT), **FRONT, again=True)

    events = [line["event"] for line in done["transitions"]]
    assert events.count("start") == 2 and len(events) < 20
    assert done["pictures"]["front"]["not_looked_at"] == 0


def test_what_no_mission_looked_at_is_counted_and_fails(recordings: Any, replayed: Replayed) -> None:
    def silent(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
        return at_ns + (number > STEP_AT) * 5 * NS_PER_S, at_ns

    done = replayed(recordings.mcap(silent, SHORT), **FRONT, status=1)

    assert done["pictures"]["front"]["not_looked_at"] == 10
    said = (
        "front camera: 10 of 15 pictures were not looked at: 10 after the mission had stopped (see --again)"
    )
    assert said in done["notes"]


def cameras(clocks: Clocks, pictures: int = 60) -> dict[CameraName, ForeignCamera]:
    """Both cameras at 15 Hz, the rear one half a picture later."""
    robot = load_robot("bonnbot")
    found = {}
    for camera in CameraName:
        size = robot.cameras.get(camera)
        image = np.full((size.height_px, size.width_px, 3), (1, 2, 3), np.uint8)
        late_ns = FRAME_NS // 2 * (camera is CameraName.REAR)
        times = [
            clocks(camera, number, BEGUN_NS + number * FRAME_NS + late_ns)
            for number in range(1, pictures + 1)
        ]
        shots = [
            Shot("cam", stamp_ns, written_ns, lambda image=image: image) for stamp_ns, written_ns in times
        ]
        found[camera] = ForeignCamera(camera, size, in_order(iter(shots)), pictures)
    return found


def through(timeline: Timeline) -> float:
    """Goes through a recording without a mission; how long that takes."""
    for tick in range(1, 2000):
        now_s = tick * TICK_S
        if timeline.ended(now_s):
            return now_s
        if timeline.step(now_s):
            timeline.step_over(now_s)
        timeline.advance(now_s)
    raise AssertionError("it does not end")


@pytest.mark.parametrize("clocks", [header_jumps, both_jump, header_steps_back, both_step_back])
def test_both_cameras_step_together(clocks: Clocks) -> None:
    both = cameras(clocks)
    timeline = Timeline("bag", both, CameraName.FRONT)

    lasted_s = through(timeline)

    assert lasted_s == pytest.approx(4.0, abs=0.2) and len(timeline.steps) == 1
    for camera in both.values():
        assert camera.counts.total == 60 and camera.counts.not_looked_at <= 1


def test_a_clock_that_is_set_in_the_other_camera_alone_costs_its_pictures_and_is_told() -> None:
    def rear_jumps(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
        return at_ns + (YEAR_NS if camera is CameraName.REAR and number > STEP_AT else 0), at_ns

    both = cameras(rear_jumps)

    through(Timeline("bag", both, CameraName.FRONT))

    left_out = LeftOut(both.values(), again=False, finished=False)
    assert left_out.much
    (said,) = left_out.said
    assert said.startswith("rear camera: 55 of 60 pictures were not looked at: ")


@pytest.mark.parametrize("apart_ns", [53 * YEAR_NS, -53 * YEAR_NS, HOUR_NS, 18 * NS_PER_S])
def test_cameras_of_two_clocks_are_refused_in_one_line(apart_ns: int) -> None:
    def two_clocks(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
        return at_ns - (apart_ns if camera is CameraName.REAR else 0), at_ns

    with pytest.raises(SettingsError, match=r"^two\.mcap: --front and --rear: the clocks .* apart[^\n]*$"):
        Timeline("two.mcap", cameras(two_clocks), CameraName.FRONT)


@pytest.mark.parametrize("begins_ns", [-HOUR_NS, 2000 * YEAR_NS])
def test_stamps_of_no_time_that_can_be_written_are_refused(begins_ns: int) -> None:
    def strange(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
        return at_ns - BEGUN_NS + begins_ns, at_ns

    with pytest.raises(
        SettingsError, match=r"^bag: its first stamp is -?\d+ s since 1970; allowed is one from 0"
    ):
        Timeline("bag", cameras(strange), CameraName.FRONT)


@pytest.mark.parametrize(
    "clocks",
    [
        pytest.param(lambda camera, number, at_ns: (at_ns, 0), id="no times of writing"),
        pytest.param(lambda camera, number, at_ns: (at_ns, YEAR_NS + number), id="converted at once"),
        pytest.param(lambda camera, number, at_ns: (number * FRAME_NS, at_ns), id="simulated time"),
    ],
)
def test_times_of_writing_of_their_own_change_nothing(clocks: Clocks) -> None:
    both = cameras(clocks)
    timeline = Timeline("bag", both, CameraName.FRONT)

    assert through(timeline) == pytest.approx(4.0, abs=0.2) and timeline.steps == []
    assert all(camera.counts.not_looked_at == 0 for camera in both.values())


def test_a_camera_that_is_silent_while_the_other_goes_on_is_no_gap() -> None:
    def dropped_out(camera: CameraName, number: int, at_ns: int) -> tuple[int, int]:
        late_ns = 15 * NS_PER_S if camera is CameraName.FRONT and number > STEP_AT else 0
        return at_ns + late_ns, at_ns + late_ns

    both = cameras(dropped_out, pictures=300)
    timeline = Timeline("bag", both, CameraName.FRONT)

    assert through(timeline) > 30 and timeline.steps == []


def shots(*stamps: float) -> list[Shot]:
    image = np.zeros((4, 4, 3), np.uint8)
    return [Shot("cam", round(each * NS_PER_S), 0, lambda: image) for each in stamps]


def seconds(found: list[Shot]) -> list[float]:
    return [each.stamp_ns / NS_PER_S for each in found]


def test_neighbours_are_put_in_order_and_nothing_is_moved_over_a_step() -> None:
    assert seconds(list(in_order(iter(shots(0.2, 0.1, 0.3, 0.5, 0.4))))) == [0.1, 0.2, 0.3, 0.4, 0.5]
    assert seconds(list(in_order(iter(shots(9.2, 9.1, 3.3, 3.2))))) == [9.1, 9.2, 3.2, 3.3]


def test_what_was_read_before_a_broken_place_is_given_first() -> None:
    def broken() -> Any:
        yield from shots(0.1, 0.2)
        raise SettingsError("broken")

    found = in_order(broken())

    assert seconds([next(found), next(found)]) == [0.1, 0.2]
    with pytest.raises(SettingsError, match="broken"):
        next(found)


def test_no_more_pictures_than_a_few_are_held() -> None:
    given: list[Shot] = []

    def counted() -> Any:
        for shot in shots(*(number / 15 for number in range(100))):
            given.append(shot)
            yield shot

    next(in_order(counted()))

    assert len(given) == LOOK_AHEAD + 1


@pytest.mark.parametrize(
    ("length_s", "said"),
    [
        (0.2, "0.2 seconds"),
        (1, "1 second"),
        (72, "1.2 minutes"),
        (3600, "1 hour"),
        (3599.9, "1 hour"),
        (53.9 * 31557600, "53 years"),
    ],
)
def test_a_length_of_time_reads_in_its_largest_unit(length_s: float, said: str) -> None:
    assert long(length_s) == said and long(-length_s) == said


def test_a_stamp_that_lacks_goes_by_the_time_of_writing_on_the_clock_of_the_others() -> None:
    def message(head_s: int, written_s: int) -> Written:
        stamp = SimpleNamespace(sec=head_s, nanosec=0)
        content = SimpleNamespace(header=SimpleNamespace(stamp=stamp))
        return Written(written_s * NS_PER_S, "sensor_msgs/msg/Image", content)

    def stamps(*heads_and_written: tuple[int, int]) -> list[int]:
        told = stamped(iter([message(*each) for each in heads_and_written]))
        return [each.stamp_ns // NS_PER_S for each in told]

    assert stamps((100, 1), (0, 2), (102, 3), (102, 4)) == [100, 101, 102, 103]
    assert stamps((0, 51), (0, 52), (0, 53)) == [51, 52, 53]
    assert stamps((7, 51), (7, 52), (7, 53)) == [7, 8, 9]
    assert stamps((0, 51), (1, 52), (2, 53)) == [0, 1, 2]
