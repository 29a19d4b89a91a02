"""What is timed: that it is the work meant, on pictures as crowded as they are called."""

from math import isfinite, isnan
from mmap import mmap
from time import process_time

import cv2
import numpy as np
import pytest

from fieldnav.evaluation.benchmark import Plan
from fieldnav.evaluation.path import PathObserver
from fieldnav.evaluation.speed_frames import STREWN, bare_primitives, frame_ms, tracking_in
from fieldnav.evaluation.speed_loop import loop_ms
from fieldnav.evaluation.speed_memory import STATM, growth_mb, memory_mb
from fieldnav.evaluation.speed_mission import mission_figures
from fieldnav.evaluation.speed_rig import rigged
from fieldnav.evaluation.speed_samples import crowded_sample, rendered_sample, strewn_sample
from fieldnav.evaluation.speed_sidestep import sidestep_figure
from fieldnav.evaluation.speed_soak import cost_figures, memory_figures, soak
from fieldnav.evaluation.speed_timing import medians_ms, one_thread
from fieldnav.perception.plants import find_plants
from fieldnav.settings.loading import load_crop, load_field, revised
from fieldnav.simulation.sketch import SketchRenderer
from states.guide import Look


def busy(seconds: float) -> None:
    until_s = process_time() + seconds
    while process_time() < until_s:
        pass


def test_a_work_costs_its_processor_time_whichever_comes_first() -> None:
    cheap, dear = (lambda: busy(0.002)), (lambda: busy(0.008))

    forward, backward = medians_ms((cheap, dear), 3), medians_ms((dear, cheap), 3)

    assert forward == pytest.approx([2, 8], rel=0.3)
    assert backward == pytest.approx([8, 2], rel=0.3)


def test_the_threads_are_given_back() -> None:
    before = cv2.getNumThreads()

    with one_thread():
        inside = cv2.getNumThreads()

    assert (inside, cv2.getNumThreads()) == (1, before)


def test_the_bare_primitives_find_what_is_green() -> None:
    image = np.full((720, 1280, 3), (72, 96, 122), np.uint8)
    cv2.circle(image, (300, 300), 40, (50, 150, 70), cv2.FILLED)
    cv2.circle(image, (900, 300), 40, (50, 150, 70), cv2.FILLED)

    count, _, _, _ = bare_primitives(image)

    assert count == 3  # the ground is one


def test_the_crowded_frame_shows_250_plants() -> None:
    sample = crowded_sample()

    centres = find_plants(sample.image, sample.crop.vegetation, sample.camera)

    assert sample.image.shape == (720, 1280, 3)
    assert len(centres) == pytest.approx(250, abs=25)


@pytest.mark.parametrize("count", [STREWN[0], STREWN[-1]])
def test_strewn_plants_are_about_as_many_as_asked_for(count: int) -> None:
    sample = strewn_sample(count)

    centres = find_plants(sample.image, sample.crop.vegetation, sample.camera)

    assert len(centres) == pytest.approx(count, rel=0.1)


def test_tracking_follows_rows_and_every_part_of_a_frame_takes_time() -> None:
    sample = strewn_sample(STREWN[0])

    tracked = tracking_in(sample)()

    assert isinstance(tracked, Look)
    assert tracked.rows_seen == len(tracked.rows) == sample.crop.rows.per_lane
    assert (frame_ms(sample, 1) > 0).all()


def test_a_sidestep_frame_with_features_costs_more_than_following_the_rows() -> None:
    sample = rendered_sample("demo", load_crop("sugar-beet"))

    figure = sidestep_figure(3)

    assert figure.value > medians_ms([tracking_in(sample)], 3)[0]
    assert figure.goal == 25


@pytest.mark.parametrize("record", [pytest.param(False, marks=pytest.mark.long), True])
def test_the_loop_is_timed_once_a_frame_while_it_tracks(record: bool) -> None:
    spent_ms, passed_ms = loop_ms(1.0, record)

    assert 10 <= len(spent_ms) == len(passed_ms) <= 15 * 8
    assert (spent_ms > 0).all()
    assert (passed_ms > 0).all()


@pytest.mark.long  # what it times is driven in tests/test_mission.py
def test_a_mission_gives_its_real_time_factor_and_leaves_memory_out_when_quick() -> None:
    factor, recorded, *rest = mission_figures(1, 4.0, Plan(None, quick=True))

    assert factor.value > 0 and factor.goal == 4
    assert recorded.value > 0
    assert rest == []


@pytest.mark.skipif(not STATM.exists(), reason="memory is read as Linux tells it")
def test_memory_that_is_taken_shows() -> None:
    before_mb = memory_mb()

    with mmap(-1, 100_000_000) as block:  # fresh pages: an allocator might give what was freed before
        for _ in range(100):
            block.write(b"x" * 1_000_000)
        taken_mb = memory_mb() - before_mb

    assert taken_mb == pytest.approx(100, rel=0.2)
    assert isfinite(before_mb)


def test_memory_that_filled_caches_and_then_leaks_is_told_by_its_leak_alone() -> None:
    now_s = np.arange(0.0, 901.0)
    held_mb = np.minimum(100 + now_s, 200) + now_s / 90  # 40 MB an hour

    assert growth_mb(now_s, held_mb, 2 / 3) == pytest.approx(40)
    assert isnan(growth_mb(now_s, np.full(901, np.nan), 2 / 3))


def test_an_hour_tells_its_memory_warm_and_at_the_end_and_its_growth_between() -> None:
    now_s = np.arange(0.0, 3601.0)
    held_mb = np.minimum(100 + now_s, 300) + now_s / 60  # 60 MB an hour

    warm, end, path, growth = memory_figures(np.stack([now_s, held_mb], axis=1), path_mb=12.0)

    assert [figure.value for figure in (warm, end, path, growth)] == pytest.approx([310, 360, 12, 60])
    assert end.met
    assert memory_figures(np.stack([now_s[:500], held_mb[:500]], axis=1), path_mb=1.0) == []


def test_a_loop_that_slows_down_is_told_by_its_early_and_late_rounds() -> None:
    spent_ms = np.concatenate([np.full(300, 4.0), np.full(400, 5.0), np.full(300, 6.0)])
    spent_ms[[5, 990]] = 50.0, 80.0  # rarer than one in a hundred

    *figures, growth = cost_figures(spent_ms)

    assert [figure.value for figure in figures] == [4.0, 4.0, 6.0, 6.0]
    assert growth.value == 1.5 and growth.met is False


def test_a_soak_counts_every_round_and_times_those_that_track_alone() -> None:
    told = []
    field = revised(load_field("demo"), {"lanes": 1, "length_m": 8.0})

    with rigged(field, SketchRenderer, lambda world: [PathObserver(world)]) as rig:
        soaked = soak(rig, 8.0, lambda *progress: told.append(progress))

    assert soaked.rounds == 400 and soaked.now_s == pytest.approx(8.0)
    assert 15 <= len(soaked.spent_ms) <= 15 * 8
    assert len(soaked.memory) == 2 * 8


@pytest.mark.long  # the soak of a shorter time is in a test before
def test_a_mission_that_is_over_ends_its_soak() -> None:
    field = revised(load_field("demo"), {"lanes": 1, "length_m": 4.0})

    with rigged(field, SketchRenderer) as rig:
        soaked = soak(rig, 60.0, lambda *progress: None)

    assert rig.mission.over and soaked.now_s < 59.0
