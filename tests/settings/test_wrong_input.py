"""Whatever is wrong in a file, one line says where, what it is and what is allowed."""

from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.errors import SettingsError
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.kinds import Kind, kind_of_document, kinds_named
from fieldnav.settings.loading import load, load_crop, load_field, load_robot, parse, revised

TEXT = {
    kind: (files("config") / kind.value / f"{name}.yaml").read_text()
    for kind, name in ((Kind.CROP, "sugar-beet"), (Kind.ROBOT, "bonnbot"), (Kind.FIELD, "demo"))
}

Write = Callable[[str], Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def written(text: str) -> Path:
        path = tmp_path / "mine.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return written


def said(kind: Kind, source: str | Path) -> str:
    with pytest.raises(SettingsError) as caught:
        load(kind, source)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def changed(kind: Kind, old: str, new: str) -> str:
    assert old in TEXT[kind]
    return TEXT[kind].replace(old, new)


CASES = {
    "a misspelt key": (
        Kind.CROP,
        "canopy_width_m: 0.20",
        "canopy_widht_m: 0.20",
        ["plants.canopy_widht_m", "0.2", "did you mean 'canopy_width_m'?", "known are spacing_m"],
    ),
    "a number above its bounds": (
        Kind.CROP,
        "canopy_width_m: 0.20",
        "canopy_width_m: 3",
        ["plants.canopy_width_m: 3 is not allowed", "from 0.02 to 1.2"],
    ),
    "a number at an open bound": (
        Kind.CROP,
        "plants:",
        "speeds: {follow_mps: 0}\nplants:",
        ["speeds.follow_mps: 0 is not allowed", "more than 0 and at most 1.5"],
    ),
    "a fraction of a row": (
        Kind.CROP,
        "per_lane: 3",
        "per_lane: 2.5",
        ["rows.per_lane: 2.5", "a whole number from 1 to 8"],
    ),
    "true for a number": (
        Kind.CROP,
        "per_lane: 3",
        "per_lane: true",
        ["rows.per_lane: true", "a whole number"],
    ),
    "a number that is none": (
        Kind.CROP,
        "plants:",
        "vegetation: {floor: .nan}\nplants:",
        ["vegetation.floor: NaN", "from 0 to 1"],
    ),
    "a method that is none": (
        Kind.CROP,
        "plants:",
        "finding: {method: hough}\nplants:",
        ["finding.method: 'hough'", "moving_variance"],
    ),
    "a value where a group belongs": (
        Kind.CROP,
        "plants:",
        "finding: 3\nplants:",
        ["finding: 3", "a group of the keys method, window"],
    ),
    "a key that is missing": (Kind.CROP, "name: sugar-beet", "", ["name: is missing", "lower-case letters"]),
    "a name that is no file name": (
        Kind.CROP,
        "name: sugar-beet",
        "name: Sugar Beet",
        ["name: 'Sugar Beet'", "lower-case letters"],
    ),
    "a key given twice": (
        Kind.CROP,
        "per_lane: 3",
        "per_lane: 3\n  per_lane: 2",
        ["line 1", "'per_lane' is given twice"],
    ),
    "code in a file": (
        Kind.CROP,
        "per_lane: 3",
        "per_lane: !!python/object/apply:os.getpid []",
        ["line 13: allowed is no tag (!!python/object/apply:os.getpid); write the plain value"],
    ),
    "a name too long for a folder": (
        Kind.CROP,
        "name: sugar-beet",
        f"name: {'x' * 300}",
        ["name: 'xxx", "lower-case letters, digits and hyphens, at most 64"],
    ),
    "a camera that looks too far up": (
        Kind.ROBOT,
        "tilt_deg: 65 # paper",
        "tilt_deg: 9.9 # paper",
        ["cameras.front.tilt_deg: 9.9 is not allowed; allowed is a number from 10 to 90"],
    ),
    "a camera that looks back": (
        Kind.ROBOT,
        "tilt_deg: 65 # paper",
        "tilt_deg: 91 # paper",
        ["cameras.front.tilt_deg: 91 is not allowed; allowed is a number from 10 to 90"],
    ),
    "a picture so tall that it shows the horizon all round": (
        Kind.ROBOT,
        "height_px: 720 # paper",
        "height_px: 8192 # paper",
        ["cameras.front: tilt_deg 65", "at 1280x8192 px", "is 154 degrees high; allowed is at most 150"],
    ),
    "a bound of many digits": (
        Kind.FIELD,
        "seed: 1",
        "seed: -1",
        ["seed: -1 is not allowed; allowed is a whole number from 0 to 2147483647"],
    ),
    "a misspelt wheel": (
        Kind.ROBOT,
        "rear_left:",
        "rear_lft:",
        ["modules.rear_lft", "did you mean 'rear_left'?"],
    ),
    "a wheel too few": (
        Kind.ROBOT,
        "  rear_left: { node_id: 4 }",
        "",
        ["modules must name each of rear_right"],
    ),
    "two wheels with one address": (Kind.ROBOT, "node_id: 2", "node_id: 1", ["four different node ids"]),
    "a drive that turns no way": (
        Kind.ROBOT,
        "node_id: 4",
        "node_id: 4, drive_direction: 0",
        ["modules.rear_left.drive_direction: 0", "-1 or 1"],
    ),
    "a date for an angle": (
        Kind.ROBOT,
        "tilt_deg: 65",
        "tilt_deg: 2020-01-01",
        ["cameras.front.tilt_deg: '2020-01-01'"],
    ),
    "a colour that is none": (
        Kind.FIELD,
        "seed: 1",
        "ground: {colour_bgr: [1, 2, 300]}",
        ["ground.colour_bgr.2: 300", "a whole number from 0 to 255"],
    ),
    "a span that runs backwards": (
        Kind.FIELD,
        "seed: 1",
        "weeds: {size_m: [0.1, 0.02]}",
        ["weeds.size_m: [0.1, 0.02]", "a smaller number first"],
    ),
    "half a span": (
        Kind.FIELD,
        "seed: 1",
        "weeds: {size_m: [0.1]}",
        ["weeds.size_m.1: is missing", "from 0.005 to 0.5"],
    ),
    "a crop nobody knows": (
        Kind.FIELD,
        "crop: sugar-beet",
        "crop: beet",
        ["crop: unknown crop 'beet'", "sugar-beet"],
    ),
}


@pytest.mark.parametrize(("kind", "old", "new", "parts"), CASES.values(), ids=CASES.keys())
def test_a_wrong_file_is_named_with_key_value_and_what_is_allowed(
    kind: Kind, old: str, new: str, parts: list[str], write: Write
) -> None:
    path = write(changed(kind, old, new))

    line = said(kind, path)

    assert line.startswith(f"{path}: ")
    for part in parts:
        assert part in line


@pytest.mark.parametrize(
    ("text", "part"),
    [("", "is empty"), ("[1, 2]", "holds a list"), ("hello", "holds a single value"), ("a: [", "line 1")],
)
def test_a_file_that_holds_no_mapping_is_refused(text: str, part: str, write: Write) -> None:
    assert part in said(Kind.CROP, write(text))


def test_an_unknown_name_lists_the_known_ones_and_the_nearest() -> None:
    line = said(Kind.CROP, "sugarbeet")

    assert "unknown crop 'sugarbeet': did you mean 'sugar-beet'?" in line
    assert "winter-wheat" in line


def test_a_path_is_named_as_it_was_typed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "field.yaml").write_text(changed(Kind.FIELD, "crop: sugar-beet", "crop: ./beet.yaml"))

    assert said(Kind.CROP, "./none.yaml") == "./none.yaml: there is no such file"
    assert said(Kind.FIELD, "./field.yaml") == "./field.yaml: crop: ./beet.yaml: there is no such file"
    assert said(Kind.FIELD, "field.yaml") == "field.yaml: crop: ./beet.yaml: there is no such file"


def test_a_file_of_many_faults_is_judged_at_once(write: Write) -> None:
    text = "".join(f"kye{number}: 1\n" for number in range(9000))

    line = said(Kind.CROP, write(text))

    assert line.startswith(f"{write(text)}: kye0: 1: there is no such key") and line.endswith("; and more")


def test_a_missing_file_a_folder_and_a_picture_are_named(tmp_path: Path) -> None:
    (tmp_path / "picture.yaml").write_bytes(b"\x89PNG\xff\xfe")

    assert said(Kind.FIELD, tmp_path / "none.yaml") == f"{tmp_path}/none.yaml: there is no such file"
    assert "cannot be read" in said(Kind.FIELD, tmp_path)
    assert "is not a text file" in said(Kind.FIELD, tmp_path / "picture.yaml")


def test_a_file_with_many_faults_names_three_and_counts_the_rest(write: Write) -> None:
    line = said(Kind.CROP, write("name: x"))

    assert line.endswith("; and 1 more")


def test_a_names_own_path_and_its_name_give_the_same_settings(write: Write) -> None:
    assert load_crop(write(TEXT[Kind.CROP])) == load_crop("sugar-beet")
    assert load_robot(write(TEXT[Kind.ROBOT])) == load_robot("bonnbot")


def test_the_path_of_a_crop_counts_from_the_field_that_names_it(tmp_path: Path) -> None:
    (tmp_path / "beet.yaml").write_text(TEXT[Kind.CROP])
    (tmp_path / "field.yaml").write_text(changed(Kind.FIELD, "crop: sugar-beet", "crop: ./beet.yaml"))

    field = load_field(tmp_path / "field.yaml")

    assert load_crop(field.crop) == load_crop("sugar-beet")


def test_a_number_in_powers_of_ten_is_a_number() -> None:
    crop = parse(CropProfile, TEXT[Kind.CROP] + "vegetation: {smallest_area_m2: 5e-4}\n", "mine.yaml")

    assert crop.vegetation.smallest_area_m2 == 0.0005


def test_options_are_checked_like_a_file() -> None:
    demo = load_field("demo")

    assert revised(demo, {"lanes": 2, "length_m": 30}) == demo.model_copy(
        update={"lanes": 2, "length_m": 30.0}
    )
    with pytest.raises(
        SettingsError, match="options: lanes: 0 is not allowed; allowed is a whole number from 1"
    ):
        revised(demo, {"lanes": 0})
    with pytest.raises(SettingsError, match=r"^--length: 3 is not allowed"):
        revised(demo, {"length_m": 3}, label="", called={"length_m": "--length"})


def test_a_name_shared_by_kinds_stands_for_each_of_them() -> None:
    assert kinds_named("sugar-beet") == [Kind.CROP, Kind.FIELD]
    assert kind_of_document({"name": 1, "lanes": 3, "length_m": 12}) is Kind.FIELD


@given(st.text(max_size=60))
def test_no_text_at_all_brings_more_than_a_settings_error(text: str) -> None:
    try:
        parse(CropProfile, text, "any.yaml")
    except SettingsError as error:
        assert "\n" not in str(error)


def groups(inner: st.SearchStrategy[object]) -> st.SearchStrategy[object]:
    keys = st.sampled_from(["rows", "plants", "name", "x"])
    return st.lists(inner, max_size=3) | st.dictionaries(keys, inner, max_size=4)


@given(st.recursive(st.none() | st.booleans() | st.floats() | st.text(max_size=5), groups))
def test_no_document_at_all_brings_more_than_a_settings_error(document: object) -> None:
    with pytest.raises(SettingsError) as caught:
        parse(CropProfile, yaml.safe_dump(document), "any.yaml")

    assert str(caught.value).startswith("any.yaml: ")


@pytest.mark.parametrize(
    ("old", "new", "shown"),
    [
        ("length_m:", '"a\\nb":', r"a\nb: 12: there is no such key"),
        ("demo", '"a\\nb"', r"name: 'a\nb' is not allowed"),
        ("sugar-beet", '"\\t"', r"crop: unknown crop '\t'"),
        ("sugar-beet", '"a\\nb.yaml"', r"a\nb.yaml: there is no such file"),
        ("sugar-beet", '"\\u2028\\u202e"', r"unknown crop '\u2028\u202e'"),
    ],
)
def test_a_line_break_in_a_key_or_a_value_breaks_no_message(
    old: str, new: str, shown: str, write: Write
) -> None:
    assert shown in said(Kind.FIELD, write(TEXT[Kind.FIELD].replace(f"{old}", new)))


def test_a_long_name_is_quoted_in_part(write: Write) -> None:
    assert (
        len(said(Kind.FIELD, write(TEXT[Kind.FIELD].replace("crop: sugar-beet", f"crop: {'x' * 3000}"))))
        < 400
    )


@pytest.mark.parametrize(
    ("options", "key"), [("false", "options"), ("[1]", "options"), ("{host: null}", "options.host")]
)
def test_what_may_be_of_several_kinds_is_named_once_with_all_of_them(
    options: str, key: str, write: Write
) -> None:
    text = TEXT[Kind.ROBOT].replace("  channel: can0", f"  channel: can0\n  options: {options}")

    message = said(Kind.ROBOT, write(text))

    assert message.count(f"can.{key}: ") == 1
    assert "text or a whole number or a number or true or false" in message


def test_a_number_that_may_be_left_out_is_said_to_be_one(write: Write) -> None:
    message = said(Kind.CROP, write(TEXT[Kind.CROP].replace("lane_pitch_m: 1.5", "lane_pitch_m: 9")))

    assert "rows.lane_pitch_m: 9 is not allowed; allowed is a number from 0.5 to 5 or null" in message
