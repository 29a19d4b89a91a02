"""A quantity over time, drawn with characters."""

import numpy as np
import pytest

from fieldnav.cli.log.chart import Course, chart

SPAN_S = (0.0, 30.0)
RISING = Course("probability", np.linspace(0, 30, 300), np.linspace(0, 0.8, 300), 0.5)
WIDTH = 49


def rows(course: Course, plain: bool) -> list[str]:
    """The drawn part alone, without title, labels and scale."""
    return [line[10:] for line in chart(course, SPAN_S, WIDTH, plain)[1:-1]]


@pytest.mark.parametrize("width", [40, 60, 80, 100])
@pytest.mark.parametrize("plain", [False, True])
def test_no_line_is_wider_than_asked(width: int, plain: bool) -> None:
    title, *lines = chart(RISING, SPAN_S, width, plain)

    assert title == "probability: 0.8, threshold 0.5"
    assert max(map(len, lines)) <= width


def test_what_rises_goes_from_the_lower_left_to_the_upper_right() -> None:
    drawn = rows(RISING, plain=True)

    assert [line.find("*") for line in drawn] == sorted((line.find("*") for line in drawn), reverse=True)
    assert drawn[0].rstrip().endswith("*") and drawn[-1].startswith("*")


def test_the_threshold_is_a_line_where_the_value_is_not() -> None:
    drawn = rows(RISING, plain=True)

    assert ["-" in line for line in drawn].count(True) == 1
    (line,) = (line for line in drawn if "-" in line)
    assert set(line[: line.find("*")]) <= {"-", " "} and line.count("-") > line.count("*") / 2


def test_braille_shows_the_same_with_more_dots() -> None:
    drawn = rows(RISING, plain=False)

    assert len(drawn) == 3
    assert all(character == " " or 0x2800 < ord(character) <= 0x28FF for line in drawn for character in line)
    assert [len(line) - len(line.lstrip()) for line in (drawn[0], drawn[-1])][1] == 0


def test_the_whole_range_and_the_span_of_time_stand_beside_it() -> None:
    _, top, *_, bottom, scale = chart(RISING, SPAN_S, WIDTH, plain=True)

    assert (top.split()[0], bottom.split()[0], scale.split()) == ("0.8", "0", ["0:00.0", "0:30.0"])


def test_a_threshold_beyond_the_values_is_within_the_picture() -> None:
    low = Course("moved", np.array([1.0, 2.0]), np.array([0.1, 0.2]), 2.5, "m")

    title, top, *_ = chart(low, SPAN_S, WIDTH, plain=True)

    assert title == "moved: 0.2 m, threshold 2.5 m"
    assert top.split()[0] == "2.5" and "-" in top


def test_what_never_changed_is_said_and_not_drawn() -> None:
    flat = Course("frames", np.array([1.0, 2.0]), np.array([0.0, 0.0]), 0.0, "frames")

    assert chart(flat, SPAN_S, WIDTH, plain=False) == ["frames: 0 frames, threshold 0 frames, all the time"]


def test_values_shortly_after_each_other_are_joined_and_others_are_not() -> None:
    at_s = np.array([0.0, 0.4, 1.6, 2.0])
    course = Course("x", at_s, np.array([0.0, 0.0, 1.0, 1.0]))

    _, top, *_, bottom, _ = chart(course, (0.0, 2.0), WIDTH, plain=True)

    assert "*******" in top and "*******" in bottom
    assert top.count("*") < 12 and bottom.count("*") < 12


def test_all_values_within_a_column_are_covered() -> None:
    shaking = Course("x", np.linspace(0, 30, 3000), np.resize([0.0, 1.0], 3000))

    assert all(set(line.rstrip()) == {"*"} for line in rows(shaking, plain=True))
