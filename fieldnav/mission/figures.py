"""The figures of a run, counted as it goes."""

from collections import Counter
from collections.abc import Collection

from fieldnav.journal.summary import Headland, Lanes, LoopHealth, Summary, Switches, Truth
from fieldnav.mission.tick import Tick
from states.names import Event
from states.table import FINISHED

SECONDS_DIGITS, METRES_DIGITS = 2, 3


class Figures:
    """Watches a mission and sums it up."""

    def __init__(self, lanes: int, done: Collection[int] = ()) -> None:
        """done: the lanes that were left behind before this run was broken off."""
        self._lanes, self._done = lanes, set(done)
        self._events: Counter[Event] = Counter()
        self._last_m: tuple[float, float] | None = None
        self._distance_m = 0.0
        self._started_s: float | None = None
        self._now_s = 0.0
        self._finished = False
        self._warnings: list[str] = []

    def watch(self, tick: Tick) -> None:
        if self._started_s is None:
            self._started_s = tick.now_s
        self._now_s = tick.now_s
        before_m, self._last_m = self._last_m, (tick.forward_m, tick.sideways_m)
        if before_m is not None:
            self._distance_m += abs(tick.forward_m - before_m[0]) + abs(tick.sideways_m - before_m[1])
        if tick.warning:
            self._warnings.append(tick.warning)
        if tick.change is not None:
            self._events[tick.change.event] += 1
            if tick.change.event in (Event.LANE_LEFT, Event.LAST_LANE_LEFT):
                self._done.add(tick.lane)
            self._finished = tick.change.target == FINISHED

    def warn(self, *said: str) -> None:
        """What a person should know besides."""
        self._warnings += said

    def summary(
        self, wall_s: float, headland: Headland, truth: Truth | None, loop: LoopHealth | None = None
    ) -> Summary:
        """The figures so far."""
        events = self._events
        duration_s = self._now_s - (self._started_s or 0.0)
        return Summary(
            completed=self._finished,
            lanes=Lanes(done=len(self._done), total=self._lanes),
            distance_m=round(self._distance_m, METRES_DIGITS),
            duration_s=round(duration_s, SECONDS_DIGITS),
            wall_s=round(wall_s, SECONDS_DIGITS),
            realtime_factor=round(duration_s / wall_s, SECONDS_DIGITS),
            transitions=events.total(),
            faults=events[Event.FAIL] + events[Event.LATCH],
            switches=Switches(attempted=events[Event.LANE_LEFT], succeeded=events[Event.LANE_CENTRED]),
            headland_m=headland,
            warnings=tuple(self._warnings),
            truth=truth,
            loop=loop,
        )
