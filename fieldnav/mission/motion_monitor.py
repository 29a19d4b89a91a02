"""What the wheels say must be seen: one camera's pictures held against the robot's own motion."""

from collections import deque
from dataclasses import dataclass
from math import cos, log, sin

import numpy as np

from fieldnav.estimation.picture_motion import DELAYS_S, Delay, Lie, PictureMotion
from fieldnav.faults import FaultKind, Trouble
from fieldnav.messages import CameraName, Floats
from fieldnav.odometry import Track
from fieldnav.perception.ground_view import GroundMap, GroundView, SeenMotion

STANDING_M = 0.02
"""Less than this within the longest delay is no motion: a picture of it shows none either."""
SHAKE_M = 0.05
"""By which shaking moves the ground from one picture to the next, at most, for a camera that looks down."""
MAX_MOVED_M = 0.11
"""After more, plants one spacing apart may be taken for each other."""
MAX_APART_S = 0.5
"""Pictures further apart are not compared: a camera that does not guide is not looked at."""
EDGE_CELLS = 2
"""Of a map, from the edge of the search."""
USUAL_LOSS_PER_S, LEARNT = 0.9, 0.05
"""Of likeness, from one picture to the next, with the time between them; and how fast a camera's own is
learnt."""
CHANCE_LOSSES = 0.65
"""Pictures that do not belong together lose anything up to so much of their likeness."""
SURE = 0.999
"""Probability of a lie from which on it is believed."""
USED_SD = 2.0
"""Standard deviations by which a delay must differ from none before pictures count as taken earlier."""
LIKELIER = 0.5
"""Probability of pictures that show the ground as it moves from which on they have a delay."""
STEADY_M = 6.0
"""Driven at one speed, in which a delay that grows could have hidden: then the speed is changed."""
PROBE_S, PROBE_SHARE, PROBED_MPS = 1.0, 0.5, 0.25
"""For so long to that share of the speed, where it is above the last. Our choice: 4 % of the time."""
DOUBT, DOUBT_S, DOUBT_SHARE = 0.02, 2.0, 0.2
"""Probability of pictures that are too late from which on the robot nearly stops, for so long, to that
share."""
CHANGE, CHANGED_S = 0.7, 1.0
"""A speed below this share of another within so long has changed by enough."""


@dataclass(frozen=True, slots=True)
class View:
    """One picture as it is compared: its ground and when it was taken."""

    ground: GroundMap
    stamp_s: float


class MotionMonitor:
    """Compares each picture with the one before, and weighs what explains all of them."""

    def __init__(self, view: GroundView, max_delay_s: float) -> None:
        """max_delay_s: pictures that are taken longer than this before their stamp are not gone by."""
        self._view, self._max_delay_s = view, max_delay_s
        self._shake_m = SHAKE_M * view.shake_share
        self._belief, self._speed = PictureMotion(view.shake_share), SpeedChange()
        self._loss_per_s = USUAL_LOSS_PER_S

    @property
    def delay(self) -> Delay:
        """By how much more the pictures are late than their stamps say."""
        return self._belief.delay

    @property
    def delay_s(self) -> float:
        """The delay to be allowed for: the measured one where it is surely there, 0 otherwise.

        Pictures that more likely do not show the ground as it moves have none.
        """
        delay = self._belief.delay
        there = delay.mean_s > USED_SD * delay.sd_s and self._belief.followed > LIKELIER
        return delay.mean_s if there else 0.0

    @property
    def speed_share(self) -> float:
        """Of the speed, by which to drive now: a change of speed shows how late the pictures are."""
        return self._speed.share

    def forget(self) -> None:
        """Begin anew: a person has seen to the camera."""
        self._belief, self._speed = PictureMotion(self._view.shake_share), SpeedChange()

    def interrupted(self) -> None:
        """Pictures or the wheels' word were missing for a moment."""
        self._belief.interrupted()

    def paused(self) -> None:
        """Nobody looked for a while: what comes then must be shown by a change of speed."""
        self._belief.paused()
        self._speed.paused()

    def trouble(self, camera: CameraName, before: View, now: View, track: Track) -> Trouble | None:
        """Why two pictures cannot be what the camera sees, one after the other, as the wheels turn.

        After it has said so the monitor begins anew: only a person lets the robot move again.
        """
        apart_s = now.stamp_s - before.stamp_s
        views = self._views(before.stamp_s, now.stamp_s, camera, track)
        if apart_s > MAX_APART_S:
            self.paused()
            return None
        if _stands(*views):
            self._belief.interrupted()
            return None
        if not self._taken_in(before, now, *views):
            return None
        found = self._judged(camera)
        if found is not None:
            self.forget()
        return found

    def _taken_in(self, before: View, now: View, before_m: Floats, now_m: Floats) -> bool:
        """Weigh the hypotheses by the two pictures; False where these show nothing to go by."""
        moved_m, apart_s = float(np.hypot(*(now_m - before_m)[:, 0])), now.stamp_s - before.stamp_s
        doubt = self._belief.later_than(self._max_delay_s) > DOUBT
        self._speed.add(now.stamp_s, moved_m, apart_s, doubt)
        seen = self._seen(before, now, moved_m)
        if seen is None:
            self._belief.interrupted()
            return False
        chance = self._chance(seen, apart_s)
        if not seen.found:
            self._belief.lost(chance)
            return True
        reach_m2 = (2 * (moved_m + self._shake_m)) ** 2
        seen_m = np.array([seen.ahead_m, seen.left_m])
        self._belief.seen(before_m, now_m, seen_m, apart_s, reach_m2, chance)
        return True

    def _chance(self, seen: SeenMotion, apart_s: float) -> float:
        """Logarithm of how likely other ground is to look so alike, over how likely the same ground is.

        The likeness that pictures of the same ground lose is exponentially distributed, its mean learnt.
        """
        usual = self._loss_per_s * apart_s
        loss = 1 - seen.likeness
        if not seen.by_plants:
            return 0.0  # bare soil looks little alike to begin with
        if seen.found:
            self._loss_per_s += LEARNT * (loss / apart_s - self._loss_per_s)
        return log(usual / CHANCE_LOSSES) + loss / usual

    def _seen(self, before: View, now: View, moved_m: float) -> SeenMotion | None:
        if moved_m > min(MAX_MOVED_M, self._view.max_motion_m - self._shake_m):
            return None
        seen = self._view.motion(before.ground, now.ground, moved_m + self._shake_m)
        return None if seen is not None and self._may_be_further(seen, moved_m) else seen

    def _may_be_further(self, seen: SeenMotion, moved_m: float) -> bool:
        """Where pitch moves the ground by decimetres, what is found at the search's edge lies beyond."""
        edge_m = moved_m + self._shake_m - EDGE_CELLS * self._view.cell_m
        return self._view.oblique and abs(seen.ahead_m) > edge_m

    def _views(
        self, before_s: float, now_s: float, camera: CameraName, track: Track
    ) -> tuple[Floats, Floats]:
        """Where the middle of the view was at both times, by each delay; shape (2, n) each.

        Along and across the view as it was, with no delay, at the first time.
        """
        x_m, y_m, heading_rad = track.all_at(np.concatenate([before_s - DELAYS_S, now_s - DELAYS_S]))
        c, s = cos(heading_rad[0]), sin(heading_rad[0])
        x_m, y_m = x_m - x_m[0], y_m - y_m[0]
        looking = 1 if camera is CameraName.FRONT else -1
        turned_m = (heading_rad - heading_rad[0]) * self._view.middle_m
        places = np.stack([looking * (c * x_m + s * y_m), looking * (c * y_m - s * x_m) + turned_m])
        return places[:, : len(DELAYS_S)], places[:, len(DELAYS_S) :]

    def _judged(self, camera: CameraName) -> Trouble | None:
        lies = {lie: self._belief.probability(lie) for lie in Lie}
        late = self._belief.later_than(self._max_delay_s)
        turned = lies[Lie.REVERSED] + lies[Lie.MIRRORED]
        past = late + lies[Lie.STILL] + lies[Lie.UNRELATED]
        if max(turned, past) < SURE:
            return None
        likeliest = max(lies, key=lambda lie: lies[lie])
        if late > lies[likeliest]:
            return self._late(camera)
        fault, said = SAID[likeliest]
        return Trouble(fault, f"{camera.value} camera: {said}")

    def _late(self, camera: CameraName) -> Trouble:
        delay = self._belief.delay
        said = (
            f"{camera.value} camera: its pictures are {delay.mean_s:.1f} s older than their stamps, "
            f"give or take {2 * delay.sd_s:.1f} s, limit {self._max_delay_s:.2f} s"
        )
        return Trouble(FaultKind.CAMERA_PAST, said)


class SpeedChange:
    """When the speed must change: after a long way at one speed, and when the pictures may be late."""

    def __init__(self) -> None:
        self._speeds: deque[tuple[float, float]] = deque()
        self._steady_m, self._now_s = 0.0, 0.0
        self._probe_share, self._probe_until_s = 1.0, float("-inf")

    @property
    def share(self) -> float:
        return self._probe_share if self._now_s < self._probe_until_s else 1.0

    def paused(self) -> None:
        """Nobody looked for a while: what comes then must be shown by a change of speed."""
        self._speeds.clear()
        self._steady_m = STEADY_M

    def add(self, now_s: float, moved_m: float, apart_s: float, doubt: bool) -> None:
        """Take in how far the wheels went from one picture to the next; doubt: whether these may be late."""
        self._now_s = now_s
        self._speeds.append((now_s, moved_m / apart_s))
        while now_s - self._speeds[0][0] > CHANGED_S:
            self._speeds.popleft()
        slowest, fastest = min(speed for _, speed in self._speeds), max(speed for _, speed in self._speeds)
        self._steady_m = 0.0 if slowest < CHANGE * fastest else self._steady_m + moved_m
        if doubt:
            self._probe(DOUBT_SHARE, DOUBT_S)
        elif self._steady_m > STEADY_M and fastest > PROBED_MPS:
            self._probe(PROBE_SHARE, PROBE_S)
        elif self._probe_share == DOUBT_SHARE:
            self._probe_until_s = min(self._probe_until_s, now_s)

    def _probe(self, share: float, seconds: float) -> None:
        """Drive slower for a moment, unless the robot has just been as slow."""
        if share < self._probe_share or self._now_s > self._probe_until_s + PROBE_S:
            self._probe_share, self._probe_until_s, self._steady_m = share, self._now_s + seconds, 0.0


def _stands(before_m: Floats, now_m: Floats) -> bool:
    """Whether the robot stood for as long as the pictures could be late."""
    places = np.concatenate([before_m, now_m], axis=1)
    return float(np.hypot(*np.ptp(places, axis=1))) < STANDING_M


AGAINST = "the ground moves against what the wheels say; it hangs upside down, or front and rear are swapped"
SAID = {
    Lie.STILL: (FaultKind.CAMERA_PAST, "the ground stands still in its pictures while the wheels drive"),
    Lie.UNRELATED: (
        FaultKind.CAMERA_PAST,
        "its pictures do not follow from one another while the wheels drive",
    ),
    Lie.REVERSED: (FaultKind.CAMERA_TURNED, AGAINST),
    Lie.MIRRORED: (FaultKind.CAMERA_TURNED, "the ground moves to the wrong side; its pictures are mirrored"),
}
