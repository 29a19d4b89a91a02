"""Where a broken-off mission goes on, for every place that a ledger may name."""

from dataclasses import replace

import pytest

from fieldnav.messages import Direction
from states.names import Follow, Path, Phase, Sidestep, text
from states.place import RUN_ON_M, Place, resumption
from states.table import LANE_LEAVES

LEAVES = pytest.mark.parametrize("leaf", LANE_LEAVES, ids=text)
FOLLOWING = [leaf for leaf in LANE_LEAVES if Phase.FOLLOW in leaf]
LEAVING = [leaf for leaf in LANE_LEAVES if Phase.EXIT in leaf]
ENTERING = [leaf for leaf in LANE_LEAVES if Sidestep.ENTERING in leaf]
BETWEEN = [leaf for leaf in LANE_LEAVES if leaf not in (*FOLLOWING, *LEAVING, *ENTERING)]


def place(leaf: Path) -> Place:
    """In or behind the second lane, half a metre from where its sidestep began."""
    return Place(
        leaf=leaf,
        lane=2,
        done=(1,),
        rows=3,
        forward_m=-4.0,
        sideways_m=-2.0,
        lane_from_m=1.5,
        lane_length_m=6.0,
        expected_m=6.5,
        pitches_m=(1.48,),
        sidestep_from_m=-1.5,
    )


@LEAVES
def test_no_place_is_left_without_a_state_to_go_on_in(leaf: Path) -> None:
    known = resumption(place(leaf))

    assert known.leaf in LANE_LEAVES
    assert known.leaf[0] is known.direction
    assert known.lane.pitches_m == (1.48,)


@pytest.mark.parametrize("leaf", FOLLOWING, ids=text)
def test_in_a_lane_its_rows_are_found_anew_and_its_beginning_is_kept(leaf: Path) -> None:
    known = resumption(place(leaf))

    assert known.leaf == (leaf[0], Phase.FOLLOW, Follow.ACQUIRING)
    assert (known.lane.number, known.lane.first_crop_m, known.lane.expected_m) == (2, 1.5, 6.5)


@pytest.mark.parametrize("leaf", LEAVING, ids=text)
def test_a_robot_on_its_way_out_of_a_lane_leaves_it_still(leaf: Path) -> None:
    known = resumption(place(leaf))

    assert known.leaf == (leaf[0], Phase.EXIT)
    assert (known.lane.number, known.moved_m) == (2, 0.0)


@pytest.mark.parametrize("leaf", BETWEEN, ids=text)
def test_from_between_two_lanes_it_goes_back_to_the_old_one_as_far_as_it_came(leaf: Path) -> None:
    known = resumption(place(leaf))

    assert known.leaf == (leaf[0], Phase.SIDESTEP, Sidestep.RETURNING)
    assert known.lane.number == 2
    ran_on_m = {Sidestep.CROSSING: RUN_ON_M, Sidestep.RETURNING: -RUN_ON_M}.get(leaf[-1], 0.0)
    assert known.moved_m == pytest.approx(-0.5 - ran_on_m)


@pytest.mark.parametrize("leaf", BETWEEN, ids=text)
def test_without_a_word_on_where_the_sidestep_began_it_has_come_no_way_yet(leaf: Path) -> None:
    known = resumption(replace(place(leaf), sidestep_from_m=None))

    assert known.leaf == (leaf[0], Phase.SIDESTEP, Sidestep.RETURNING)
    assert known.moved_m == 0.0


@pytest.mark.parametrize("leaf", ENTERING, ids=text)
def test_a_robot_that_drives_in_is_in_the_next_lane_and_goes_the_other_way(leaf: Path) -> None:
    known = resumption(place(leaf))

    assert isinstance(leaf[0], Direction)
    assert known.leaf == (leaf[0].opposite, Phase.FOLLOW, Follow.ACQUIRING)
    assert known.direction is leaf[0].opposite
    assert (known.lane.number, known.lane.first_crop_m, known.lane.expected_m) == (3, None, 6.0)


@LEAVES
def test_a_place_knows_which_way_the_lane_is_driven(leaf: Path) -> None:
    assert place(leaf).direction is leaf[0]
