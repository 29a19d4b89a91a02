"""What is timed: that it is the work meant, on pictures as crowded as they are called."""

from math import isfinite
from mmap import mmap
from time import process_time

import cv2
import numpy as np
import pytest

from fieldnav.evaluation.benchmark import Plan
from fieldnav.evaluation.speed_frames import STREWN, bare_primitives, frame_ms, tracking_in
from fieldnav.evaluation.speed_loop import loop_ms
from fieldnav.evaluation.speed_memory import STATM, memory_figures, memory_mb
from fieldnav.evaluation.speed_mission import mission_figures
from fieldnav.evaluation.speed_samples import crowded_sample, rendered_sample, strewn_sample
from fieldnav.evaluation.speed_sidestep import sidestep_figure
from fieldnav.evaluation.speed_timing import medians_ms, one_thread
from fieldnav.perception.plants import find_plants
from fieldnav.settings.loading import load_crop
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


def test_the_loop_is_timed_once_a_frame_while_it_tracks() -> None:
    spent_ms = loop_ms(1.0)

    assert 10 <= len(spent_ms) <= 15 * 8
    assert (spent_ms > 0).all()


def test_a_mission_gives_its_real_time_factor_and_leaves_memory_out_when_quick() -> None:
    factor, *rest = mission_figures(1, 4.0, Plan(None, quick=True))

    assert factor.value > 0 and factor.goal == 4
    assert rest == []


@pytest.mark.skipif(not STATM.exists(), reason="memory is read as Linux tells it")
def test_memory_that_is_taken_shows() -> None:
    before_mb = memory_mb()

    with mmap(-1, 100_000_000) as block:  # fresh pages: an allocator might give what was freed before
        block.write(b"x" * len(block))
        taken_mb = memory_mb() - before_mb

    assert taken_mb == pytest.approx(100, rel=0.2)
    assert isfinite(before_mb)


def test_memory_that_filled_caches_and_then_leaks_is_told_by_its_leak_alone() -> None:
    now_s = np.arange(0.0, 901.0)
    held_mb = np.minimum(100 + now_s, 200) + now_s / 90  # 40 MB an hour

    growth, hour = memory_figures("demo", now_s, held_mb)

    assert growth.value == pytest.approx(40)
    assert hour.value == pytest.approx(200 + 40) and hour.met
