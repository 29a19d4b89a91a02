"""What the behaviours of one lane and of one switch hand to each other; made anew for each."""

from collections import Counter
from dataclasses import dataclass, field

from fieldnav.estimation.lane_end import LaneEnd
from fieldnav.odometry import Pose
from fieldnav.perception.recognition import Descriptors
from fieldnav.perception.sidestep.passing_rows import Crossing
from states.guide import Guide, Look
from states.names import Path

OFTEN = 0.1
"""Share of a lane's frames: gaps hide a row in most of them at times, but not in nine of ten."""


@dataclass(slots=True)
class SwitchMemory:
    """One sidestep: the rows as they pass, the features of the outermost known one, how often it was tried.

    started_m, started_forward_m: what the wheels had travelled sideways and ahead when it began; exposed:
    where the last frame was taken in which the rows were followed; looks: how often the next lane was looked
    for; refused: why it was not taken; rows_counted: its rows as seen so far; pitch_m: distance from the old
    lane to it.
    """

    started_m: float
    started_forward_m: float = 0.0
    reference: Descriptors | None = None
    crossing: Crossing | None = None
    exposed: Pose | None = None
    looks: int = 1
    refused: str = ""
    rows_counted: int = 0
    pitch_m: float | None = None


@dataclass(slots=True)
class LaneMemory:
    """One lane: what guides along it, where it ends, and how many rows were seen how often.

    expected_m: the length of the lanes before, None on the first; from_m: the driven distance at which its
    first crop was judged, where it is known from before; pitches_m: distances from lane to lane, as the
    switches before have found them; resumes: the state in which a broken-off mission goes on in this lane.
    """

    number: int
    expected_m: float | None = None
    from_m: float | None = None
    under_way: bool = False
    trailing: Look | None = None
    counts: Counter[int] = field(default_factory=Counter)
    switch: SwitchMemory | None = None
    pitches_m: tuple[float, ...] = ()
    resumes: Path | None = None
    _guide: Guide | None = None
    _end: LaneEnd | None = None

    def enter(self, guide: Guide, end: LaneEnd) -> None:
        """The lane has been found; found again, it still ends where it did."""
        self._guide, self._end, self.under_way = guide, self._end or end, True

    @property
    def first_crop_m(self) -> float | None:
        """The driven distance at which the lane's first crop was judged; None before that."""
        return self._end.first_m if self._end else self.from_m

    @property
    def length_m(self) -> float | None:
        """From the lane's first crop to the last that was seen; None before any was."""
        return self._end.length_m() if self._end and self._end.first_m is not None else None

    @property
    def guide(self) -> Guide:
        assert self._guide, "Acquiring hands over the guide"
        return self._guide

    @property
    def end(self) -> LaneEnd:
        assert self._end, "Acquiring begins to look for the end"
        return self._end

    @property
    def switching(self) -> SwitchMemory:
        assert self.switch, "Orienting begins the switch"
        return self.switch

    def after(self) -> "LaneMemory":
        """The memory of the lane that follows."""
        length_m = self.length_m if self._end else self.expected_m
        pitch_m = self.switch.pitch_m if self.switch else None
        pitches_m = self.pitches_m if pitch_m is None else (*self.pitches_m, pitch_m)
        return LaneMemory(self.number + 1, length_m, pitches_m=pitches_m)

    @property
    def rows_passed(self) -> int:
        """New rows counted in this lane's switch so far."""
        return self.switch.rows_counted if self.switch else 0

    @property
    def rows(self) -> int:
        """C, the number of rows under the robot: the most that were seen together often; 0 before any was."""
        often = OFTEN * self.counts.total()
        return max((rows for rows, frames in self.counts.items() if frames >= often), default=0)
