"""A value that YAML readers disagree about is refused with advice, never taken for something else."""

import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from fieldnav.errors import SettingsError
from fieldnav.settings.documents import parse_mapping, written
from fieldnav.settings.loading import load_crop, load_robot, parse
from fieldnav.settings.robot import Robot
from fieldnav.settings.setting import all_changed


def said(value: str) -> str:
    with pytest.raises(SettingsError) as caught:
        parse_mapping(f"modules:\n  left:\n    - pulses: {value}\n", "robot.yaml")
    return str(caught.value)


@pytest.mark.parametrize(
    ("value", "instead"),
    [
        *[("01024", "1024"), ("-007", "-7"), ("00", "0"), ("08", "8"), ("+01.50", "1.50"), ("00.5", "0.5")],
        *[("0o17", "15"), ("0b11", "3"), ("-0b1_0", "-2"), ("1_000", "1000"), ("1_0.5", "10.5")],
        *[("1:30", "a decimal number"), ("190:20:30.5", "a decimal number"), ("09:15", "a decimal number")],
        *[("yes", "true"), ("On", "true"), ("y", "true"), ("no", "false"), ("OFF", "false"), ("N", "false")],
    ],
)
def test_a_value_that_readers_take_for_different_things_is_refused_with_advice(
    value: str, instead: str
) -> None:
    line = said(value)

    assert line.startswith(f"robot.yaml: line 3: modules.left.0.pulses: {value} is not allowed: ")
    assert line.endswith(f"; write {instead}, or write '{value}' in quotes for text")


@pytest.mark.parametrize(
    "text",
    [
        *["1234e5", "00e1", "0x1A2B", "0b_", "0x_", "1:99", "00:1a:2b", "NO!", "2020-01-01", "0123abc"],
        *["=", "_1", "1.2.3", "nO", "\u0661\u0662", "\uff11\uff12"],
    ],
)
def test_what_is_no_decimal_number_stays_text(text: str) -> None:
    assert parse_mapping(f"serial: {text}\n", "x") == {"serial": text}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        *[("0", 0), ("+1", 1), ("-12", -12), (".5", 0.5), ("5.", 5.0), ("0.50", 0.5), ("1.5e3", 1500.0)],
        *[("5e-4", 0.0005), ("1e+2", 100.0), ("TRUE", True), ("False", False), ("Null", None), ("~", None)],
        *[("", None), ("-.INF", -math.inf)],
    ],
)
def test_a_plain_value_is_what_every_reader_takes_it_for(text: str, value: object) -> None:
    found = parse_mapping(f"a: {text}\n", "x")["a"]

    assert found == value and type(found) is type(value)


def test_a_key_is_the_text_it_is_written_as() -> None:
    assert parse_mapping("no: 1\n01: 2\n1: 3\n~: 4\n", "x") == {"no": 1, "01": 2, "1": 3, "~": 4}


def test_a_serial_number_in_quotes_or_of_hexadecimal_digits_reaches_the_bus_as_it_is_written() -> None:
    options = "options: {serial: 1234e5, id: '00112', app: 0x1A2B, name: 'no'}"
    text = written(load_robot("bonnbot").model_dump(mode="json")).replace("options: {}", options)

    robot = parse(Robot, text, "robot.yaml")

    assert robot.can.options == {"serial": "1234e5", "id": "00112", "app": "0x1A2B", "name": "no"}
    again = written(robot.model_dump(mode="json"))
    assert parse(Robot, again, "again") == robot
    assert "serial: '1234e5'" in again and "app: '0x1A2B'" in again


@pytest.mark.parametrize(
    ("value", "instead"), [("1e3", "1000"), ("0x10", "16"), ("'1024'", "1024"), ("two", "")]
)
def test_text_where_a_number_belongs_is_refused_with_the_number(value: str, instead: str) -> None:
    text = written(load_robot("bonnbot").model_dump(mode="json"))
    wrong = text.replace("encoder_pulses: 1024", f"encoder_pulses: {value}", 1)

    with pytest.raises(SettingsError, match=r"encoder_pulses: '.*' is not allowed; allowed is a") as caught:
        parse(Robot, wrong, "robot.yaml")

    assert str(caught.value).endswith(f"; write {instead}" if instead else "from 1 to 100000")


@example("\x85")
@example("a\x85b\n")
@example("a\u2028b\u2029")
@given(st.text(max_size=12) | st.from_regex(r"[-+]?[0-9a-fxob_:.eE+-]{1,8}", fullmatch=True))
def test_text_is_written_so_that_it_is_read_as_the_same(text: str) -> None:
    content = written({"a": text})

    try:
        assert parse_mapping(content, "x") == {"a": text}
    except SettingsError as error:
        assert "control character" in str(error)


@given(st.floats(allow_nan=False) | st.integers() | st.booleans() | st.none())
def test_a_value_is_written_so_that_it_is_read_as_the_same(value: object) -> None:
    content = written({"a": value})

    if len(content) < 40:
        assert parse_mapping(content, "x") == {"a": value}


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ("robot.can.options={port: 0123}", "port: 0123 is not allowed: .* write 123"),
        ("switching.headland_m=01.5", "01.5 is not allowed: .* write 1.5"),
        ("switching.headland_m=no", "no is not allowed: .* write 'no' in quotes"),
        ("switching.headland_m=&a {b: *a}", "allowed is no anchor"),
        ("switching.headland_m=*a", "allowed is no alias"),
    ],
)
def test_an_option_value_is_read_as_files_are_and_refused_with_the_reason(change: str, why: str) -> None:
    key = change.partition("=")[0].removeprefix("robot.")

    with pytest.raises(SettingsError, match=f"^--set {key}: '.*' is no value: {why}"):
        all_changed(load_crop("sugar-beet"), load_robot("bonnbot"), [change])
