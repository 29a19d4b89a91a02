"""The stretches of time that a recording is made of, one after another on the run's clock.

A recording has gaps, and clocks are set while it goes on. What lies between two stretches is skipped over:
the second begins on the run's clock at once, where the first one ends.
"""

from collections.abc import Mapping

from fieldnav.errors import SettingsError
from fieldnav.messages import CameraName
from fieldnav.recording.stamps import LAST_NS
from fieldnav.replay.foreign.camera import ForeignCamera
from fieldnav.replay.foreign.odometry import ToldTwist
from fieldnav.replay.foreign.shot import NS_PER_S
from fieldnav.replay.foreign.steps import MAX_GAP_S, long

MAX_CLOCKS_APART_S = 5.0
"""Of two topics' stamps, as against when they were written; more than pictures wait anywhere. Our choice."""
MAX_TOLD = 5
"""Steps that are told one by one."""


class Timeline:
    """Reads on in all cameras; `begun_ns`: the stamp at the run's second 0, as the present stretch has it."""

    def __init__(
        self,
        name: str,
        cameras: Mapping[CameraName, ForeignCamera],
        leading: CameraName,
        odometry: ToldTwist | None = None,
    ) -> None:
        """name: of the recording. Raises SettingsError where the stamps are of clocks that differ."""
        self._cameras, self._leading, self._odometry = cameras, cameras[leading], odometry
        self._steps: list[str] = []
        for other in cameras.values():
            _check_clock(name, self._leading, f"--{other.name.value}", other)
        if odometry is not None:
            _check_clock(name, self._leading, "--odometry", odometry)
        self.begun_ns = min(each.next.stamp_ns for each in cameras.values() if each.next is not None)
        if not 0 <= self.begun_ns <= LAST_NS:
            raise SettingsError(
                f"{name}: its first stamp is {self.begun_ns // NS_PER_S} s since 1970; "
                f"allowed is one from 0 to {LAST_NS // NS_PER_S} s"
            )
        if odometry is not None:
            odometry.step_over(self.begun_ns, back=False)

    @property
    def steps(self) -> list[str]:
        """What is to be told of the steps so far."""
        more = len(self._steps) - MAX_TOLD
        return [*self._steps[:MAX_TOLD], *([f"the stamps step {more} times more"] if more > 0 else [])]

    def ended(self, now_s: float) -> bool:
        """Whether nothing more comes, or nothing with which a mission could begin anew."""
        return self._leading.ended and self._is_silent(now_s)

    def step(self, now_s: float) -> str:
        """What is told of a step that comes now; empty where none comes."""
        if self._leading.ended or not (self._leading.clock_set or self._is_silent(now_s)):
            return ""
        step_ns, count = self._leading.step_ns, self._leading.counts.taken + self._leading.counts.dropped
        way = "jump by" if step_ns > 0 else "step back by"
        return (
            f"{self._leading.name.value} camera: the stamps {way} {long(step_ns / NS_PER_S)} "
            f"after picture {count}"
        )

    def step_over(self, now_s: float) -> None:
        """Go on behind the step, which is kept to be told."""
        self._steps.append(self.step(now_s))
        assert self._leading.next is not None, "there is a step only before a picture"
        back, begins_ns = self._leading.step_ns < 0, self._leading.next.stamp_ns
        for camera in self._cameras.values():
            if camera is not self._leading:
                camera.step_over(begins_ns, back)
        self._leading.step_over(begins_ns, back=False)
        self.begun_ns = begins_ns - round(now_s * NS_PER_S)
        if self._odometry is not None:
            self._odometry.step_over(self.begun_ns, back)

    def advance(self, now_s: float) -> dict[CameraName, int]:
        """How many pictures of each camera came by now. Raises SettingsError for a broken file."""
        return {
            name: camera.advance(now_s, self.begun_ns, leads=camera is self._leading)
            for name, camera in self._cameras.items()
        }

    def _is_silent(self, now_s: float) -> bool:
        """Whether no camera gives a picture for longer than a gap."""
        coming = [each.next.stamp_ns for each in self._cameras.values() if each.next is not None]
        return not coming or (min(coming) - self.begun_ns) / NS_PER_S - now_s > MAX_GAP_S


def _check_clock(name: str, leading: ForeignCamera, option: str, other: ForeignCamera | ToldTwist) -> None:
    """Stamps may differ by as much as the times of writing do. Raises SettingsError."""
    if leading.next is None or other.next is None:
        return
    stamps_ns = other.next.stamp_ns - leading.next.stamp_ns
    written_ns = other.next.written_ns - leading.next.written_ns
    apart_s = (stamps_ns - written_ns) / NS_PER_S
    if abs(apart_s) > MAX_CLOCKS_APART_S:
        raise SettingsError(
            f"{name}: --{leading.name.value} and {option}: the clocks of their stamps are {long(apart_s)} "
            f"apart, by when they were written; allowed are topics with stamps of one clock, "
            f"or --{leading.name.value} alone"
        )
