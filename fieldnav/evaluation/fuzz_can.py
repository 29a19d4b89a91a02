"""Thousands of frames thrown at one end of the bus, and whether it broke or moved; the seed decides all."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from enum import Enum
from random import Random
from typing import Protocol

import can

from fieldnav.evaluation.benchmark import Failure
from fieldnav.evaluation.fuzz_frames import FrameFuzz, written
from fieldnav.evaluation.fuzz_recording import good_telegrams
from fieldnav.mission.loop import TICK_S

MOST_WRITTEN = 6
"""Frames of the last tick that a failure names; one of them did it."""

SPELL_TICKS = 50
"""So long frames come at one rate: quiet enough that all goes well, or a flood; a second, our choice."""


class Part(Enum):
    """What the frames are thrown at."""

    DRIVER = "driver"
    MISSION = "mission"
    MODULES = "modules"
    TRACKING = "tracking"


@dataclass(frozen=True, slots=True)
class Bout:
    """So many frames at most, thrown at one target from the start."""

    part: Part
    index: int
    frames: int
    seed: int

    @property
    def title(self) -> str:
        return f"{self.part.value}:{self.index}"

    @property
    def again(self) -> str:
        return f"fieldnav bench fuzz --seed {self.seed} --again {self.title}"


@dataclass(frozen=True, slots=True)
class Fought:
    """How a bout went: frames thrown, and what broke or moved, if anything did."""

    bout: Bout
    frames: int
    crash: Failure | None = None
    motion: Failure | None = None


class Target(Protocol):
    """What frames are thrown at; `rates` are frames a tick.

    It bears the errors that it should raise; whatever else comes out is a crash.
    """

    third: can.BusABC
    rates: Sequence[float]
    left_out: frozenset[int]

    @property
    def open(self) -> bool:
        """Whether frames are thrown yet."""
        ...

    @property
    def over(self) -> bool:
        """Whether nothing more can come of it."""
        ...

    def tick(self, now_s: float) -> str:
        """One tick; what moved that should stand, or how it moved that it should not; else empty."""
        ...


Prepare = Callable[[Bout, Random], AbstractContextManager[Target]]


def fight(bout: Bout, prepare: Prepare) -> Fought:
    """Throw the bout's frames until they are all thrown, the target is over, or something went wrong."""
    random = Random(f"{bout.seed} {bout.title}")
    with prepare(bout, random) as target:
        fuzz = FrameFuzz(random, good_telegrams(), target.left_out)
        thrown, tick, rate = 0, 0, 0.0
        while thrown < bout.frames and not target.over:
            if tick % SPELL_TICKS == 0:
                rate = random.choice(target.rates)
            tick += 1
            wanted = _count(random, rate) if target.open else 0
            frames = [fuzz.draw(tick * TICK_S) for _ in range(min(wanted, bout.frames - thrown))]
            for frame in frames:
                target.third.send(frame)
            thrown += len(frames)
            try:
                moved = target.tick(tick * TICK_S)
            except Exception as error:  # whatever it is, it is what is looked for
                said = f"{type(error).__name__}: {' '.join(str(error).split())}"
                return Fought(bout, thrown, crash=_failure(bout, said, tick, frames))
            if moved:
                return Fought(bout, thrown, motion=_failure(bout, moved, tick, frames))
    return Fought(bout, thrown)


def _count(random: Random, rate: float) -> int:
    """Frames of one tick: the rate on average."""
    return int(rate) + (random.random() < rate % 1) if rate < 1 else random.randint(0, round(2 * rate))


def _failure(bout: Bout, said: str, tick: int, frames: list[can.Message]) -> Failure:
    last = " ".join(map(written, frames[:MOST_WRITTEN]))
    more = f" and {len(frames) - MOST_WRITTEN} more" if len(frames) > MOST_WRITTEN else ""
    return Failure(bout.title, f"{said}; in tick {tick}, frames {last or 'none'}{more}", bout.again)
