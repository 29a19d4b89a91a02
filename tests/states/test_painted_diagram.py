"""A run painted into the diagram: what it did is told in figures and stands out, what it did not is pale."""

import re
import subprocess
import sys
from xml.etree import ElementTree

import pytest

from fieldnav.messages import Direction
from states.drawing.paint import TIMES, Paint, Visit, clock, shade, width
from states.drawing.painted import PALE, painted
from states.names import Event, Follow, Path, Phase
from states.table import CHECKING, IDLE, LATCHED, LEAVES, PAUSED, RECOVERABLE, RESUMING, TRANSITIONS

SVG = "{http://www.w3.org/2000/svg}"
ACQUIRING: Path = (Direction.FORWARD, Phase.FOLLOW, Follow.ACQUIRING)
TRACKING: Path = (Direction.FORWARD, Phase.FOLLOW, Follow.TRACKING)
COASTING: Path = (Direction.FORWARD, Phase.FOLLOW, Follow.COASTING)
RUN = Paint(
    name="field <1>",
    outcome="stopped",
    reason="module rear_left & its wheel",
    visits={
        IDLE: Visit(0.0, 1),
        CHECKING: Visit(2.0, 1),
        ACQUIRING: Visit(1.0, 1),
        TRACKING: Visit(90.0, 4),
        COASTING: Visit(7.0, 2),
        PAUSED: Visit(20.0, 1),
        RECOVERABLE: Visit(0.0, 1),
    },
    made={
        (IDLE, Event.START, CHECKING): 1,
        (CHECKING, Event.READY, ACQUIRING): 1,
        (ACQUIRING, Event.ROWS_FOUND, TRACKING): 1,
        (TRACKING, Event.ROWS_LOST, COASTING): 2,
        (COASTING, Event.ROWS_FOUND, TRACKING): 2,
        (TRACKING, Event.PAUSE, PAUSED): 1,
        (PAUSED, Event.RESUME, TRACKING): 1,
        (COASTING, Event.FAIL, RECOVERABLE): 1,
        (TRACKING, Event.FAIL, RECOVERABLE): 2,
    },
    ended=RECOVERABLE,
)


def texts(picture: str, kind: str | None = None) -> list[str]:
    root = ElementTree.fromstring(picture)
    return [str(each.text) for each in root.iter(f"{SVG}text") if kind in (None, each.get("class"))]


def test_every_state_that_was_entered_says_for_how_long_and_how_often() -> None:
    told = texts(painted(RUN))

    for words in (
        f"1{TIMES}",
        f"2.0 s · 1{TIMES}",
        f"1.0 s · 1{TIMES}",
        f"1:30 · 4{TIMES}",
        f"7.0 s · 2{TIMES}",
        f"20.0 s · 1{TIMES}",
    ):
        assert words in told
    assert told.count(f"1{TIMES}") == 2  # Idle and Recoverable, in which no time was spent
    assert texts(painted(RUN), "time")[-2:] == ["1:38", "1:38"], "Follow and all of Forward"


def test_every_arrow_says_how_often_it_was_taken_and_the_others_nothing() -> None:
    events = texts(painted(RUN), "event")
    taken = sorted(words for words in events if TIMES in words)

    assert taken == sorted(
        [
            f"start {TIMES}1",
            f"ready {TIMES}1",
            f"rows found {TIMES}1",
            f"rows found {TIMES}2",
            f"rows lost {TIMES}2",
            f"pause {TIMES}1",
            f"resume {TIMES}1",
            f"fail {TIMES}3",
        ]
    )
    assert len(events) == len(TRANSITIONS)


def test_what_never_occurred_is_pale_and_what_occurred_is_not() -> None:
    root = ElementTree.fromstring(painted(RUN))
    arrows = [each for each in root.iter(f"{SVG}path") if each.get("class") == "arrow"]
    pale = [each for each in arrows if each.get("stroke") == PALE]
    boxes = [each for each in root.iter(f"{SVG}rect") if each.get("class") == "leaf"]

    assert len(arrows) - len(pale) == 8 + 1, "eight ways taken, and the one to where it begins"
    assert len(pale) == len(TRANSITIONS) - 8
    faint = [each for each in boxes if PALE in str(each.get("style"))]
    assert len(faint) == len(LEAVES) - len(RUN.visits)


def test_the_longer_in_a_state_the_darker_and_the_more_often_the_wider() -> None:
    def light(leaf: Path) -> int:
        return int(shade(RUN.depth(leaf))[1:3], 16)

    assert light(RESUMING) == light(IDLE) == 255 > light(CHECKING) > light(COASTING) > light(TRACKING)
    assert 0 < width(1) < width(2) < width(8) < width(64) == width(1000)


def test_the_state_in_which_it_ended_is_marked() -> None:
    picture = painted(RUN)

    assert texts(picture).count("ended here") == 1
    (mark,) = [
        each for each in ElementTree.fromstring(picture).iter(f"{SVG}rect") if each.get("class") == "ended"
    ]
    boxes = [
        each for each in ElementTree.fromstring(picture).iter(f"{SVG}rect") if each.get("class") == "leaf"
    ]
    places = [(each.get("x"), each.get("y")) for each in boxes]
    assert places.index((mark.get("x"), mark.get("y"))) == LEAVES.index(RECOVERABLE)
    assert "ended here" not in painted(Paint("x", "broken off", "", {}, {}))


def test_the_heading_names_the_run_and_its_outcome_whatever_they_contain() -> None:
    told = texts(painted(RUN))

    assert told[:3] == ["field <1>", "stopped · 2:00 in all", "module rear_left & its wheel"]
    assert not re.findall(r"(?:href|src|@import|url\((?!#))", painted(RUN))


def test_transitions_of_another_version_are_owned_up_to() -> None:
    told = texts(painted(Paint("x", "finished", "", {}, {}, unknown=2)))

    assert "finished · 0.0 s in all · transitions that this version does not have: 2" in told


def test_a_long_reason_is_cut_and_a_run_of_nothing_is_drawn() -> None:
    told = texts(painted(Paint("x", "stopped", "word " * 100, {}, {})))

    assert any(words.endswith("…") for words in told)


def test_a_transition_to_where_the_mission_was_interrupted_is_drawn_there_whatever_its_target() -> None:
    made = {
        (PAUSED, Event.RESUME, leaf): 1 for leaf in (TRACKING, COASTING, CHECKING)
    }  # each goes on where it was
    times = Paint("x", "finished", "", {}, made).times()

    assert times == {(PAUSED, Event.RESUME, None): 3}


def test_an_event_of_a_composite_does_not_count_for_a_state_outside_it() -> None:
    made = {(PAUSED, Event.LATCH, LATCHED): 1, (TRACKING, Event.LATCH, LATCHED): 1}
    times = Paint("x", "stopped", "", {}, made).times()

    assert times == {(PAUSED, Event.LATCH, LATCHED): 1, ((Direction.FORWARD,), Event.LATCH, LATCHED): 1}


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.0, "0.0 s"), (4.24, "4.2 s"), (59.96, "1:00"), (83.0, "1:23"), (3723.4, "1:02:03")],
)
def test_times_read_as_clocks_do(seconds: float, words: str) -> None:
    assert clock(seconds) == words


def test_the_picture_is_the_same_in_every_process() -> None:
    code = "from states.diagram import svg; print(svg())"
    drawn = {
        subprocess.run(
            [sys.executable, "-c", code], env={"PYTHONHASHSEED": seed}, check=True, capture_output=True
        ).stdout
        for seed in ("1", "2", "3")
    }

    assert len(drawn) == 1
