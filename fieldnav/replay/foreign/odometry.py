"""How the recorded robot moved, as its odometry tells: nav_msgs/Odometry."""

from collections.abc import Iterator
from math import inf

from fieldnav.errors import SettingsError
from fieldnav.messages import STANDSTILL, Twist
from fieldnav.replay.foreign.container import ROS_ODOMETRY, Container, Told
from fieldnav.replay.foreign.shot import NS_PER_S
from fieldnav.replay.foreign.steps import is_step

SILENT_S = 0.5
"""Odometry older than this tells nothing more; the robot then counts as standing. Our choice."""


def odometry(container: Container, topic: str) -> Iterator[Told]:
    """The messages of an odometry topic. Raises SettingsError, with the topics there are, for another one."""
    there = [each for each, kind in container.topics.items() if kind == ROS_ODOMETRY]
    if topic not in there:
        allowed = f"allowed are {', '.join(sorted(there))}" if there else "it holds none; leave it out"
        raise SettingsError(f"{container.name}: --odometry {topic}: is no odometry; {allowed}")
    return container.read(topic)


class ToldTwist:
    """The newest twist up to a time, which must not fall. Raises SettingsError where the file is broken."""

    def __init__(self, messages: Iterator[Told], begun_ns: int = 0) -> None:
        """begun_ns: the stamp at second 0."""
        self._messages, self._begun_ns = messages, begun_ns
        self.next = next(messages, None)
        self._twist, self._told_s = STANDSTILL, -inf

    def __call__(self, now_s: float) -> Twist:
        while self.next is not None:
            stamp_s = (self.next.stamp_ns - self._begun_ns) / NS_PER_S
            if stamp_s > now_s:
                break
            said = self.next.content.twist.twist
            self._twist = Twist(float(said.linear.x), float(said.linear.y), float(said.angular.z))
            self._told_s = stamp_s
            self.next = next(self._messages, None)
        return self._twist if now_s - self._told_s <= SILENT_S else STANDSTILL

    def step_over(self, begun_ns: int, back: bool) -> None:
        """The stamps count from another one on; back: what is of the clock before it was set is left out."""
        while back and self.next is not None:
            before_ns, self.next = self.next.stamp_ns, next(self._messages, None)
            if self.next is not None and is_step(before_ns, self.next.stamp_ns):
                break
        self._begun_ns, self._told_s = begun_ns, -inf
