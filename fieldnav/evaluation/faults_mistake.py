"""A state's behaviour with a mistake in it."""

from dataclasses import dataclass

from fieldnav.messages import CameraName
from states.behaviour import Observation, Step


@dataclass(frozen=True, slots=True)
class Mistaken:
    """Raises what nobody expected, as soon as it is asked."""

    cameras: tuple[CameraName, ...]

    def step(self, seen: Observation) -> Step:
        raise ZeroDivisionError(f"a mistake at {seen.now_s:.2f} s")
