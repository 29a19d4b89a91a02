"""The queue is bounded: pictures give way first, then everything, and what was left out is counted."""

from threading import Thread
from typing import Any

from fieldnav.recording.message import Message, Topic
from fieldnav.recording.queue import BoundedQueue

BOUND = 100


def bytes_of(made_up: Any, size: int, picture: bool = False) -> Any:
    return made_up.item([Message(Topic.LOG, 0.0, bytes(size))], picture)


def test_what_is_put_comes_out_in_order(made_up: Any) -> None:
    queue = BoundedQueue(BOUND, waits=False)
    put = [bytes_of(made_up, size) for size in (1, 2, 3)]
    for item in put:
        queue.put(item)

    assert [queue.get().item for _ in put] == put


def test_a_full_queue_leaves_pictures_out_and_counts_them(made_up: Any) -> None:
    queue = BoundedQueue(BOUND, waits=False)
    for _ in range(5):
        queue.put(bytes_of(made_up, 40, picture=True))
    queue.put(bytes_of(made_up, 40))

    got = [queue.get() for _ in range(3)]
    assert [one.pictures_before for one in got] == [0, 0, 3]
    assert [one.item.picture for one in got] == [True, True, False]


def test_what_is_no_picture_is_let_in_up_to_twice_the_bound(made_up: Any) -> None:
    queue = BoundedQueue(BOUND, waits=False)
    for _ in range(7):
        queue.put(bytes_of(made_up, 40))

    assert [queue.get().others_before for _ in range(5)] == [0] * 5
    assert queue.close() == (0, 2)


def test_what_is_being_written_counts_until_it_is_done(made_up: Any) -> None:
    queue = BoundedQueue(BOUND, waits=False)
    queue.put(bytes_of(made_up, 90, picture=True))
    first = queue.get()
    queue.put(bytes_of(made_up, 90, picture=True))
    queue.done(first)
    queue.put(bytes_of(made_up, 80, picture=True))

    second = queue.get()
    assert (second.size, second.pictures_before) == (80, 1)


def test_what_is_larger_than_the_bound_is_let_in_alone(made_up: Any) -> None:
    queue = BoundedQueue(BOUND, waits=False)

    queue.put(bytes_of(made_up, 3 * BOUND, picture=True))

    assert queue.get().size == 3 * BOUND


def test_one_that_waits_loses_nothing(made_up: Any) -> None:
    queue = BoundedQueue(BOUND, waits=True)
    put = [bytes_of(made_up, 60 + number, picture=True) for number in range(20)]
    putting = Thread(target=lambda: [queue.put(item) for item in put])
    putting.start()
    got = []
    for _ in put:
        waiting = queue.get()
        got.append(waiting.item)
        assert waiting.pictures_before == 0
        queue.done(waiting)
    putting.join()

    assert got == put


def test_whoever_waits_for_room_is_let_go_when_the_queue_closes(made_up: Any) -> None:
    queue = BoundedQueue(BOUND, waits=True)
    queue.put(bytes_of(made_up, BOUND))
    putting = Thread(target=queue.put, args=(bytes_of(made_up, BOUND),))
    putting.start()

    queue.close()
    putting.join()

    assert queue.get().size == BOUND
    assert queue.get() is None
