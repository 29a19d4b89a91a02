"""What a run was told to do is read back, or refused in one line."""

import pytest

from fieldnav.errors import SettingsError
from fieldnav.journal.resolved import Option
from fieldnav.messages import Side
from fieldnav.replay.order import order_of
from states.names import Event


def test_the_options_of_a_run_are_its_order() -> None:
    order = order_of(
        {"lanes": 2, "side": "left", "dry_run": True, "confirm": "lane left, rows lost", "video": False}
    )

    assert (order.lanes, order.side, order.dry_run) == (2, Side.LEFT, True)
    assert order.asked == {Event.LANE_LEFT, Event.ROWS_LOST}


def test_nobody_is_asked_where_nothing_was_to_be_confirmed() -> None:
    assert order_of({"lanes": 1, "side": "right", "confirm": ""}).asked == frozenset()


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"side": "up"}, "settings.yaml: options: side: 'up'"),
        ({"side": None}, "side: null"),
        ({"lanes": 2.5}, r"lanes: 2\.5"),
        ({"dry_run": "perhaps"}, "dry_run: 'perhaps'"),
        ({"confirm": "lane left,"}, "confirm: 'lane left,'; allowed is some of"),
    ],
)
def test_what_no_run_was_told_is_refused(changes: dict[str, Option], said: str) -> None:
    with pytest.raises(SettingsError, match=said):
        order_of({"lanes": 1, "side": "right"} | changes)


@pytest.mark.parametrize("key", ["lanes", "side"])
def test_an_option_that_decides_must_be_there(key: str) -> None:
    options: dict[str, Option] = {"lanes": 1, "side": "right"}
    del options[key]
    with pytest.raises(SettingsError, match=f"{key}"):
        order_of(options)
