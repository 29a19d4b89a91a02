"""A settings file is plain data; whatever else YAML can hold is one line and never a crash or a wait."""

import os
from pathlib import Path

import pytest

from fieldnav.errors import SettingsError
from fieldnav.settings.documents import LARGEST_FILE_BYTES, parse_mapping, read_text
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.loading import load_field, parse

FIELD = "name: mine\ncrop: sugar-beet\nlanes: 1\nlength_m: 4\n"


def said(text: str) -> str:
    with pytest.raises(SettingsError) as caught:
        parse(FieldSettings, text, "mine.yaml")
    line = str(caught.value)
    assert line.startswith("mine.yaml: ") and "\n" not in line
    return line


@pytest.mark.parametrize(
    ("value", "named"),
    [
        ("!!bool foo", "!!bool"),
        ("!!int ''", "!!int"),
        ("!!timestamp foo", "!!timestamp"),
        ("!!float x", "!!float"),
        ("!!binary zz", "!!binary"),
        ("!!set {a, b}", "!!set"),
        ("!!omap [a: 1]", "!!omap"),
        ("!mine 3", "!mine"),
        ("! 3", "!"),
    ],
)
def test_a_tag_is_refused_by_its_name(value: str, named: str) -> None:
    assert said(f"{FIELD}wind_mps: {value}\n") == (
        f"mine.yaml: line 5: allowed is no tag ({named}); write the plain value"
    )


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("gaps: &a {germination: 0.5, x: *a}\n", "line 5: allowed is no anchor (&a); write the values out"),
        ("gaps: *a\n", "line 5: allowed is no alias (*a); write the values out"),
        ("gaps: {<<: {germination: 1}}\n", "line 5: allowed is no merge key (<<); write the values out"),
        ("<<: {seed: 3}\n", "line 5: allowed is no merge key (<<); write the values out"),
    ],
)
def test_what_shares_values_is_refused(text: str, problem: str) -> None:
    assert said(FIELD + text) == f"mine.yaml: {problem}"


def test_a_small_file_that_unfolds_into_a_huge_one_is_refused_at_its_first_anchor() -> None:
    lines = ["a: &a [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"{name}: &{name} [{', '.join(f'*{before}' for _ in range(10))}]" for before, name in PAIRS]

    assert "line 1: allowed is no anchor (&a)" in said("\n".join(lines))


PAIRS = list(zip("abcdefgh", "bcdefghi", strict=True))


@pytest.mark.parametrize("number", ["9" * 6000, "0b" + "1" * 6000, "1" * 50 + ".5"])
def test_a_number_of_thousands_of_digits_is_refused(number: str) -> None:
    assert f"a number of {len(number)} characters; allowed are at most 40" in said(f"{FIELD}seed: {number}\n")


@pytest.mark.parametrize(
    "value", ["0b_", "0x_", "=", "<<", "2001-99-99", "2020-01-01", "1e999", "-.inf", "~"]
)
def test_what_only_looks_like_a_number_is_refused(value: str) -> None:
    said(f"{FIELD}wind_mps: {value}\n")


@pytest.mark.parametrize(
    ("text", "code"), [('"a\\0.yaml"', "0000"), ('"\\ud800"', "d800"), ('"a\\x1b.yaml"', "001b")]
)
def test_text_with_a_character_that_is_none_is_refused(text: str, code: str) -> None:
    line = said(FIELD.replace("sugar-beet", text))

    assert line == f"mine.yaml: line 2: allowed is no control character (\\u{code}) in text"


@pytest.mark.parametrize("opening", ["[", "{a: ", "- "])
def test_endless_nesting_is_refused(opening: str) -> None:
    assert "is nested more than 20 deep" in said(f"name: x\nrows:\n  {opening * 3000}")


@pytest.mark.parametrize("key", ["? [a, b]\n", "? {a: b}\n"])
def test_a_key_that_is_no_word_is_refused(key: str) -> None:
    assert "line 5: a list or a mapping cannot be a key" in said(f"{FIELD}{key}: 3\n")


def test_a_long_misspelt_key_does_not_fill_the_screen() -> None:
    assert len(said(f"{FIELD}? {'k' * 50_000}\n: 3\n")) < 400


def test_a_file_that_is_larger_than_any_profile_is_refused(tmp_path: Path) -> None:
    large = tmp_path / "large.yaml"
    large.write_bytes(b"#" * (LARGEST_FILE_BYTES + 1))

    with pytest.raises(SettingsError, match=f"{large}: .* allowed is a file of at most {LARGEST_FILE_BYTES}"):
        read_text(str(large))
    large.write_bytes(b"#" * LARGEST_FILE_BYTES)
    assert len(read_text(str(large))) == LARGEST_FILE_BYTES


def test_a_pipe_is_refused_and_not_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.yaml"
    os.mkfifo(pipe)

    with pytest.raises(SettingsError, match="cannot be read: is a pipe or a device; allowed is a file"):
        load_field(pipe)


@pytest.mark.parametrize("name", ["x" * 300 + ".yaml", "a\0.yaml", "\ud800.yaml"])
def test_a_name_that_no_file_can_have_is_refused(name: str) -> None:
    with pytest.raises(SettingsError) as caught:
        load_field(name)
    assert "\n" not in str(caught.value)


def test_a_file_as_some_editors_write_it_is_read(tmp_path: Path) -> None:
    marked = tmp_path / "marked.yaml"
    marked.write_bytes(b"\xef\xbb\xbf" + FIELD.replace("\n", "\r\n").encode())

    assert load_field(marked).lanes == 1


def test_plain_values_keep_their_meaning() -> None:
    text = "a: 1\nb: 2.5\nc: 1e-3\nd: true\ne: ~\nf: two words\ng: [1, {h: -16}]\ni: 2020-01-01\n"

    assert parse_mapping(text, "x") == {
        "a": 1,
        "b": 2.5,
        "c": 0.001,
        "d": True,
        "e": None,
        "f": "two words",
        "g": [1, {"h": -16}],
        "i": "2020-01-01",
    }
