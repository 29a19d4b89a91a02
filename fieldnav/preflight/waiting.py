"""How time goes by while something is watched."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Watch:
    """The clock of the frames' stamps, in s, and waiting for so many s."""

    clock: Callable[[], float]
    wait: Callable[[float], None]
