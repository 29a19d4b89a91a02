"""Several frames must tell the same before a state believes them."""

from fieldnav.messages import Evidence
from fieldnav.perception.found import LEAST_CONFIDENCE
from fieldnav.perception.lane import LaneFit
from states.names import Event

OFFSET_M = 0.06
"""Two looks at the same lane differ by less: camera shake of 1 degree moves the ground by 2 cm."""
SLOPE = 0.12
"""The same for the heading's tangent; few short rows give it within some degrees."""


class Agreement:
    """Counts looks at the lane that agree with the one before."""

    def __init__(self, needed: int) -> None:
        self.needed = needed
        self.looks = 0
        self._last: LaneFit | None = None

    def add(self, fit: LaneFit | None) -> bool:
        """Take in one frame's lane; true once enough frames in a row agree."""
        last, self._last = self._last, fit
        if fit is None:
            self.looks = 0
        elif last and abs(fit.offset_m - last.offset_m) < OFFSET_M and abs(fit.slope - last.slope) < SLOPE:
            self.looks += 1
        else:
            self.looks = 1
        return self.looks >= self.needed

    def evidence(self, fires: Event | None = None, alone: bool = False) -> tuple[Evidence, ...]:
        """What speaks for the lane; `fires`: the event that agreement is a condition of, or enough for alone.

        A lane that is less sure than the confidence wanted is none: alone, the frames that agree imply it.
        """
        sure = self._last.confidence if self._last else 0.0
        return (
            Evidence("frames that agree on the lane", self.looks, self.needed, "frames", fires, alone=alone),
            Evidence("confidence in the lane", sure, LEAST_CONFIDENCE, "", None if alone else fires),
        )
