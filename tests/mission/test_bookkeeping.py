"""What the ledger keeps of a mission is what the states are given back."""

from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fieldnav.errors import FieldnavError
from fieldnav.estimation.lane_end import LaneEnd
from fieldnav.journal.ledger import Booking, Ledger, last_booking
from fieldnav.messages import Direction, Side
from fieldnav.mission.bookkeeping import ALONG_M, ASIDE_M, Bookkeeping, place_of
from fieldnav.mission.travel import Travel
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop, load_robot
from fieldnav.settings.robot import Robot
from states.behaviour import Task
from states.behaviours import Behaviours
from states.guides import guide_for
from states.memory import LaneMemory, SwitchMemory
from states.names import Follow, Phase, Sidestep, text
from states.names import Path as StatePath
from states.table import CHECKING, FINISHED, LANE_LEAVES, RECOVERABLE

TRACKING: StatePath = (Direction.FORWARD, Phase.FOLLOW, Follow.TRACKING)
CROSSING: StatePath = (Direction.FORWARD, Phase.SIDESTEP, Sidestep.CROSSING)
METRES = st.floats(-200, 200)
PERHAPS = st.none() | METRES


class Books:
    """The books of a mission that stands where the test says."""

    def __init__(self, path: Path, robot: Robot, crop: CropProfile) -> None:
        pinholes = robot.cameras.pinholes()
        task = Task(crop, pinholes, Side.LEFT, lanes=9)
        self.path, self.task = path, task
        self.ledger = Ledger(path)
        self.behaviours, self.travel = Behaviours(task), Travel(robot)
        self.books = Bookkeeping(self.ledger, task, self.behaviours, self.travel)

    def newest(self) -> Booking:
        booking = last_booking(self.path)
        assert booking is not None
        return booking

    def lines(self) -> int:
        return len(self.path.read_bytes().splitlines())


@pytest.fixture(scope="module")
def shipped() -> SimpleNamespace:
    return SimpleNamespace(robot=load_robot("bonnbot"), crop=load_crop("sugar-beet"))


@pytest.fixture
def books(tmp_path: Path, shipped: SimpleNamespace) -> Iterator[Books]:
    made = Books(tmp_path / "ledger.jsonl", shipped.robot, shipped.crop)
    yield made
    made.ledger.close()


@settings(max_examples=30)  # each waits for the disk
@given(
    leaf=st.sampled_from(LANE_LEAVES),
    number=st.integers(1, 9),
    done=st.sets(st.integers(1, 9)).map(lambda lanes: tuple(sorted(lanes))),
    travelled_m=st.tuples(METRES, METRES),
    known_m=st.tuples(PERHAPS, PERHAPS, PERHAPS),
    pitches_m=st.lists(st.floats(0.5, 3), max_size=3).map(tuple),
    began_m=PERHAPS,
)
def test_a_place_comes_back_from_the_ledger_as_it_was_written(
    leaf: StatePath,
    number: int,
    done: tuple[int, ...],
    travelled_m: tuple[float, float],
    known_m: tuple[float | None, float | None, float | None],
    pitches_m: tuple[float, ...],
    began_m: float | None,
    shipped: SimpleNamespace,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    books = Books(tmp_path_factory.mktemp("run") / "ledger.jsonl", shipped.robot, shipped.crop)
    from_m, expected_m, _ = known_m
    switch = None if began_m is None else SwitchMemory(began_m)
    books.behaviours.lane = LaneMemory(number, expected_m, from_m, pitches_m=pitches_m, switch=switch)
    books.behaviours.done = done
    books.travel.forward_m, books.travel.sideways_m = travelled_m

    books.books.book(1.5, leaf)
    books.ledger.close()

    place, kept = place_of(books.newest()), books.books.newest
    assert place == kept
    assert (place.leaf, place.lane, place.done, place.pitches_m) == (leaf, number, done, pitches_m)
    assert (place.forward_m, place.sideways_m) == travelled_m
    assert (place.lane_from_m, place.expected_m) == (from_m, expected_m)
    assert place.sidestep_from_m == (began_m if Phase.SIDESTEP in leaf else None)


def test_a_line_says_what_the_mission_is_about(books: Books) -> None:
    books.books.book(12.25, TRACKING)

    newest = books.newest()
    assert (newest.stamp_s, newest.state, newest.side, newest.lanes) == (12.25, text(TRACKING), "left", 9)
    assert not newest.finished


def test_the_place_is_booked_again_after_decimetres_along_and_centimetres_aside(books: Books) -> None:
    books.books.book(0.0, CROSSING)
    for forward_m, sideways_m, lines in [
        (0.9 * ALONG_M, 0.0, 1),
        (1.1 * ALONG_M, 0.0, 2),
        (1.1 * ALONG_M, -0.9 * ASIDE_M, 2),
        (1.1 * ALONG_M, -1.1 * ASIDE_M, 3),
        (1.8 * ALONG_M, -1.9 * ASIDE_M, 4),
    ]:
        books.travel.forward_m, books.travel.sideways_m = forward_m, sideways_m

        books.books.travelled(1.0, CROSSING)

        assert books.lines() == lines


def test_states_that_stand_are_not_booked_so_that_the_last_place_stays(books: Books) -> None:
    books.books.book(1.0, CHECKING)
    assert last_booking(books.path) is None

    books.books.book(2.0, TRACKING)
    books.books.book(3.0, RECOVERABLE)

    assert (books.lines(), books.newest().state) == (1, text(TRACKING))


def test_the_end_is_booked_at_the_last_place_with_every_lane_done(books: Books) -> None:
    books.books.book(1.0, (Direction.BACKWARD, Phase.EXIT))
    books.behaviours.done = (1, 2, 3)

    books.books.book(2.0, FINISHED)

    newest = books.newest()
    assert newest.finished
    assert (newest.state, newest.done) == ("Backward.Exit", (1, 2, 3))


def test_writing_a_place_down_judges_nothing_of_the_lane(books: Books) -> None:
    lane, end = books.behaviours.lane, LaneEnd(books.task.crop, 4.0, None)
    lane.enter(guide_for(books.task, Direction.FORWARD), end)

    books.books.book(1.0, TRACKING)

    assert end.first_m is None
    assert (books.newest().lane_from_m, books.newest().lane_length_m) == (None, None)


def test_a_mission_without_a_ledger_still_knows_its_place(shipped: SimpleNamespace) -> None:
    pinholes = shipped.robot.cameras.pinholes()
    task = Task(shipped.crop, pinholes, Side.LEFT, lanes=1)
    books = Bookkeeping(None, task, Behaviours(task), Travel(shipped.robot))

    books.book(1.0, TRACKING)

    assert books.newest is not None
    assert books.newest.leaf == TRACKING


@pytest.mark.parametrize("state", ["Forward.Flying", "Checking", ""])
def test_a_state_that_is_none_of_a_lanes_is_refused(state: str) -> None:
    booking = Booking(
        stamp_s=0, state=state, side="left", lanes=1, lane=1, done=(), rows=0, forward_m=0, sideways_m=0
    )

    with pytest.raises(FieldnavError, match=f"^state: '{state}' is none of a lane's"):
        place_of(booking)
