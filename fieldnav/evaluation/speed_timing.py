"""How a cost is taken: this process's processor time, so that neither other programs nor waiting count.

OpenCV has one thread. Works that are compared take turns, and the median over the rounds stands for each.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from time import process_time

import cv2
import numpy as np

from fieldnav.messages import Floats

Work = Callable[[], object]

MILLISECONDS = 1000.0


@contextmanager
def one_thread() -> Iterator[None]:
    """Hold OpenCV to one thread for a while."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        yield
    finally:
        cv2.setNumThreads(threads)


def medians_ms(works: Sequence[Work], rounds: int) -> Floats:
    """What each work costs, in ms of processor time, shape (works,); a round before the first warms up."""
    spent_s = np.empty((rounds + 1, len(works)))
    for turn in spent_s:
        for place, work in enumerate(works):
            started_s = process_time()
            work()
            turn[place] = process_time() - started_s
    return np.asarray(np.median(spent_s[1:], axis=0) * MILLISECONDS)
