"""Good pictures are driven by without a word, in a sketched field as in one that is drawn."""

import pytest

from fieldnav.evaluation.picture_watching import Watching, watch
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised


@pytest.mark.parametrize("drawn", [False, True], ids=["sketched", "drawn"])
def test_two_lanes_are_driven_up_and_down_and_no_good_picture_is_refused(drawn: bool) -> None:
    field = revised(load_field("demo"), {"lanes": 2, "length_m": 4, "seed": 5})
    done = watch(Watching(field, load_crop(field.crop), smaller(load_robot("bonnbot")), drawn))
    assert done.alarms == ()
    assert done.driven_m > 2 * 4
    assert done.frames > 200
