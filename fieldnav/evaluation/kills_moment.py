"""When a mission's process is killed: at any moment, about a transition, or soon after its start."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from multiprocessing.process import BaseProcess
from pathlib import Path
from random import Random
from threading import Event, Thread

MEAN_S = 10.0
"""Of the robot's time between kills: three lanes of five to six metres take some two minutes."""
RESUMING_MEAN_S = 1.5
"""Checks take one to two seconds, looking for the place as long again at most."""
SPREAD_S = 0.03
"""Of the machine's time, about what a few rounds of the loop take: a kill comes anywhere within them."""
NEAR_S = 0.05
"""So soon after a transition, of the machine's time."""
POLL_S = 0.0002
"""Between looks whether the journal has grown: a line of it takes about a millisecond."""


class Moment(Enum):
    """What the process is likely to be doing as it is killed."""

    ANY = "any"
    TRANSITION = "transition"
    RESUMING = "resuming"


SHARES = {Moment.ANY: 0.45, Moment.TRANSITION: 0.35, Moment.RESUMING: 0.2}
AGAIN = 0.5
"""Share of kills while resuming that are followed by another one such."""


@dataclass(frozen=True, slots=True)
class Kill:
    """after_s: of the robot's time since the process began; delay_s: then, of the machine's time."""

    moment: Moment
    after_s: float
    delay_s: float


def kills(random: Random, mean_s: float = MEAN_S) -> Iterator[Kill]:
    """One after another without end; mean_s: of the robot's time between them."""
    moment = Moment.ANY
    while True:
        again = moment is Moment.RESUMING and random.random() < AGAIN
        moment = moment if again else random.choices(list(SHARES), list(SHARES.values()))[0]
        after_s = random.expovariate(1 / (RESUMING_MEAN_S if moment is Moment.RESUMING else mean_s))
        # Within a transition itself, between its line and the ledger's, more often than long after it.
        delay_s = NEAR_S * random.random() ** 2 if moment is Moment.TRANSITION else SPREAD_S * random.random()
        yield Kill(moment, after_s, delay_s)


class Killer:
    """Kills one process once, from a thread of its own, so that it is struck in whatever it does."""

    def __init__(self, process: BaseProcess, kill: Kill, journal: Path) -> None:
        self._process, self._kill, self._journal = process, kill, journal
        self._called_off = Event()
        self._thread: Thread | None = None

    def time_is(self, since_start_s: float) -> None:
        """Take aim once the moment has come."""
        if self._thread is None and since_start_s >= self._kill.after_s:
            self._thread = Thread(target=self._strike, daemon=True)
            self._thread.start()

    def call_off(self) -> None:
        """Nothing is killed after this."""
        self._called_off.set()
        if self._thread is not None:
            self._thread.join()

    def _strike(self) -> None:
        if self._kill.moment is Moment.TRANSITION:
            size = self._size()
            while self._size() == size:
                if self._called_off.wait(POLL_S):
                    return
        if not self._called_off.wait(self._kill.delay_s):
            with suppress(ProcessLookupError):
                self._process.kill()

    def _size(self) -> int:
        try:
            return self._journal.stat().st_size
        except FileNotFoundError:
            return 0
