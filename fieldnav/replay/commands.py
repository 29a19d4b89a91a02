"""What a replay does, tick by tick: what it judges, and how its commands differ from those of the run."""

from collections.abc import Iterator

from fieldnav.inquiry.chances import chances
from fieldnav.journal.entry import Judged
from fieldnav.messages import Evidence
from fieldnav.mission.tick import Tick
from fieldnav.recording.records import Ticked
from fieldnav.replay.difference import Commands

FORGOTTEN_S = 3.0
"""So long after a difference the wheels count as obeying again: no watch looks back further."""


class CommandWatch:
    """An observer of the replay; holds each of its ticks against the one of then."""

    def __init__(self, then: Iterator[Ticked]) -> None:
        self._then = then
        self._next: Ticked | None = next(then, None)
        self.commands = Commands()
        self._judged: tuple[Evidence, ...] = ()
        self._differed_s = -float("inf")

    def watch(self, tick: Tick) -> None:
        """Note what was judged, and by how much the velocities differ."""
        self._judged = tick.step.evidence or self._judged
        while self._next is not None and self._next.now_s < tick.now_s:
            self._next = next(self._then, None)
        if self._next is None or self._next.now_s != tick.now_s:
            return
        then, now = self._next, tick.passed.motion.twist
        most = self.commands
        self.commands = most.model_copy(
            update={
                "vx_mps": max(most.vx_mps, abs(now.vx_mps - then.vx_mps)),
                "vy_mps": max(most.vy_mps, abs(now.vy_mps - then.vy_mps)),
                "yaw_rate_rps": max(most.yaw_rate_rps, abs(now.yaw_rate_rps - then.yaw_rate_rps)),
            }
        )

    def lacked(self, event: str) -> str:
        """What an event lacked at the last look, in words; empty where that is not known."""
        judged = [Judged.of(each) for each in self._judged]
        for chance in chances(judged):
            if chance.event == event and not chance.holds:
                (least,) = chance.deciding
                value = "unknown" if least.value is None else f"{least.value:.3g}"
                wanted = f"{least.bound.value} {least.threshold:.3g} {least.unit}"
                return f"{least.name} {value}, wanted {wanted}".strip()
        return ""

    def sent(self, now_s: float, alike: bool) -> None:
        """Whether the frames of a round are those of then, bit for bit."""
        if alike:
            return
        self._differed_s = now_s
        first_s = now_s if self.commands.first_s is None else self.commands.first_s
        self.commands = self.commands.model_copy(
            update={"rounds": self.commands.rounds + 1, "first_s": first_s}
        )

    def obeyed(self, now_s: float) -> bool:
        """Whether the recorded wheels do what the replay tells them."""
        return now_s - self._differed_s > FORGOTTEN_S
