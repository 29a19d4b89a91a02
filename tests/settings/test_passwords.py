"""What a person or a report is shown of a camera's source holds no password."""

import pytest

from fieldnav.errors import SettingsError
from fieldnav.report.settings_list import settings_groups
from fieldnav.settings.documents import written
from fieldnav.settings.loading import load_crop, load_robot, parse
from fieldnav.settings.robot import Robot
from fieldnav.settings.setting import all_changed

SOURCES = [
    "rtsp://user:hunter2@10.0.0.7/h264",
    "http://10.0.0.7/video?pw=hunter2",
    "rtspsrc user-pw=hunter2 ! x",
]


@pytest.mark.parametrize("source", SOURCES)
def test_the_report_lists_the_settings_without_it(source: str) -> None:
    groups = settings_groups({"robot": {"cameras": {"front": {"source": source}}}, "sources": [source]})

    assert "***" in str(groups) and "hunter2" not in str(groups)


@pytest.mark.parametrize("source", SOURCES)
@pytest.mark.parametrize(
    ("key", "wrong"),
    [
        ("source: /dev/video0", "sorce: '{}'"),
        ("rate_hz: 15.0", "rate_hz: '{}'"),
        ("cameras:", "cameras: {{front: '{}'}}\nx:"),
    ],
)
def test_an_error_quotes_a_value_without_it(key: str, wrong: str, source: str) -> None:
    text = written(load_robot("bonnbot").model_dump(mode="json"))
    assert key in text

    with pytest.raises(SettingsError) as caught:
        parse(Robot, text.replace(key, wrong.format(source), 1), "robot.yaml")

    assert "hunter2" not in str(caught.value)


def test_the_report_hides_what_is_named_a_password() -> None:
    (group,) = settings_groups({"robot": {"can": {"options": {"user-pw": "hunter2", "port": 3}}}})

    assert group == ("robot", [("can.options.user-pw", "***"), ("can.options.port", "3")])


@pytest.mark.parametrize("value", ["07551", "7551_1", "[07551]", "{a: 7551}", "[7551]"])
def test_a_password_that_is_refused_is_not_quoted(value: str) -> None:
    text = written(load_robot("bonnbot").model_dump(mode="json"))

    with pytest.raises(SettingsError, match=r"can\.options\.password") as caught:
        parse(Robot, text.replace("options: {}", f"options: {{password: {value}}}"), "robot.yaml")

    assert "7551" not in str(caught.value)


@pytest.mark.parametrize("source", SOURCES)
def test_an_option_that_is_refused_is_quoted_without_it(source: str) -> None:
    changes = [
        f"robot.cameras.front.source=[{source}, &a]",
        f"robot.cameras.front.rate_hz='{source}'",
        source,
    ]

    for change in changes:
        with pytest.raises(SettingsError) as caught:
            all_changed(load_crop("sugar-beet"), load_robot("bonnbot"), [change])
        assert "hunter2" not in str(caught.value)
