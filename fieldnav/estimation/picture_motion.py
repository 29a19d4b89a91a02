"""Whether the ground moves through a camera's pictures as the wheels say, and how late the pictures are.

A bank of hypotheses: one for each delay of the pictures, and a few for what else they may show: ground that
stands still, that moves the other way, or mirrored, or pictures that do not follow from one another. Each
hypothesis carries the ground along by what the wheels said at its own time, and is weighed by how well that
fits what was seen: an interacting multiple model filter (Blom and Bar-Shalom, 1988).

Within a hypothesis two quantities are estimated for each axis: the scale, seen over said (the camera's
height, plants that stand up from the ground, slip), and the lag, by how much the ground that was carried
along is ahead of the ground that was seen. The camera's shaking moves the ground to and fro by a few
centimetres. It is the noise of the lag: it does not add up over distance as real motion does.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from fieldnav.messages import Floats

STEP_S, MAX_DELAY_S = 0.1, 4.0
DELAYS_S: Floats = np.linspace(0.0, MAX_DELAY_S, round(MAX_DELAY_S / STEP_S) + 1)
"""Shape (n,): by how much more the pictures may be late than their stamps say."""
LIKELY_DELAY_S = 0.15
"""Standard deviation of the delay before anything was seen."""
UNLIKELY, IMPOSSIBLE = 1e-4, 1e-8
"""Probability of a lie before anything was seen; and the least of any hypothesis: a lie begins at any
time."""
AFTER_JUMP, AFTER_PAUSE = 0.3, 1e-3
"""Probability of anything after pictures that do not follow from those before: time may have jumped; and
after a while in which nobody looked."""
SHAKING_M2: Floats = np.array([[0.035], [0.025]]) ** 2
"""Variance of the lag along and across the view: a degree rms of pitch and roll, doubled, for it repeats."""
PATH_M2_PER_M, SCALE2_PER_M = 0.025**2, 0.02**2
"""Variance that lag and scale gain per metre: slip, uneven ground, plants of other heights."""
SCALE_SD, OTHER_SCALE_SD, MIN_SCALE, MAX_SCALE = 0.2, 0.1, 0.5, 2.0
DRIFT_S2_PER_S = 0.06**2
"""Variance that the delay gains a second."""
LIES_THEN = 0.3
"""Share of it that is not a delay but a lie: a camera that was turned has jumped as well."""
OUTLIERS = 0.02
"""Share of pairs of pictures in which other ground is taken for the same."""
MAX_CHANCE = 3.5
"""Logarithm of how much one picture alone may speak for pictures that do not follow from one another: 30
times."""
SURPRISE = 3.0
"""Logarithm of how much more likely two pictures must be not to belong together before time may have
jumped."""


class Lie(Enum):
    """What pictures may show instead of the ground that moves as the wheels say."""

    STILL = "still"
    REVERSED = "reversed"
    MIRRORED = "mirrored"
    UNRELATED = "unrelated"


SIGNS: Floats = np.array([[0.0, -1.0, 1.0], [0.0, -1.0, -1.0]])
"""Shape (2, 3): times what the wheels say along and across the view, for the first three lies."""
_N, _ALL = len(DELAYS_S), len(DELAYS_S) + len(SIGNS.T)
_PLACE = {lie: _N + number for number, lie in enumerate(Lie)}
"""Of each lie among all hypotheses."""
_SELF = np.arange(_ALL)
_FROM = np.stack([np.where(_SELF < _N, (_SELF - 1).clip(0), _SELF), _SELF,
                  np.where(_SELF < _N, (_SELF + 1).clip(max=_N - 1), _SELF)])  # fmt: skip
"""Shape (3, all): the hypotheses that each comes from, its delay having grown, stayed, or shrunk."""


@dataclass(frozen=True, slots=True)
class Delay:
    """By how much more the pictures are late than their stamps say."""

    mean_s: float
    sd_s: float


class PictureMotion:
    """What is believed of one camera's pictures."""

    def __init__(self, shake_share: float = 1.0) -> None:
        """shake_share: how far pitch moves the ground along the view, against one that looks down."""
        further = np.array([[shake_share], [1.0]]) ** 2
        self._shaking_m2: Floats = SHAKING_M2 * further
        self._path_m2_per_m: Floats = PATH_M2_PER_M * further
        likely = np.exp(-0.5 * (DELAYS_S / LIKELY_DELAY_S) ** 2)
        self._weights: Floats = np.concatenate([likely / likely.sum(), np.zeros(len(Lie))])
        self._raise(UNLIKELY)
        self._scale: Floats = np.ones((2, _ALL))
        self._lag: Floats = np.zeros((2, _ALL))
        self._scale2: Floats = np.full((2, _ALL), SCALE_SD**2)
        self._both: Floats = np.zeros((2, _ALL))
        self._lag2: Floats = np.tile(self._shaking_m2, _ALL)

    @property
    def delay(self) -> Delay:
        """The delay, provided that the pictures show the ground as it moves."""
        weights = self._weights[:_N] / self._weights[:_N].sum()
        mean_s = float(weights @ DELAYS_S)
        return Delay(mean_s, float(np.sqrt(weights @ (DELAYS_S - mean_s) ** 2)))

    @property
    def followed(self) -> float:
        """Probability that the pictures show the ground as it moves, however late."""
        return float(self._weights[:_N].sum())

    def later_than(self, limit_s: float) -> float:
        """Probability that the pictures show the ground, but later than that."""
        return float(self._weights[:_N][limit_s < DELAYS_S].sum())

    def probability(self, lie: Lie) -> float:
        return float(self._weights[_PLACE[lie]])

    def interrupted(self) -> None:
        """Pictures were left out: the ground is carried along from the next one, all else holds."""
        self._lag[:], self._lag2[:], self._both[:] = 0.0, self._shaking_m2, 0.0

    def paused(self) -> None:
        """Nobody looked for a while."""
        self._spread(AFTER_PAUSE)

    def lost(self, chance: float) -> None:
        """The ground of one picture was not found again in the next; chance: as in `seen`."""
        self.interrupted()
        self._weights[-1] *= np.exp(min(chance, MAX_CHANCE))
        self._weights /= self._weights.sum()
        self._spread(AFTER_JUMP)

    def seen(
        self,
        before_m: Floats,
        after_m: Floats,
        seen_m: Floats,
        apart_s: float,
        reach_m2: float,
        chance: float,
    ) -> None:
        """Take in how the ground moved from one picture to the next.

        before_m, after_m: shape (2, n), along and across the view: where the wheels say that the view was, by
        each delay, when the two pictures were taken; seen_m: shape (2,), how the view moved over the ground
        by them, found within an area of reach_m2. chance: logarithm of how likely two pictures that do not
        belong together are to look so alike, over how likely two that do are.
        """
        moved_m = np.hypot(*(after_m - before_m)[:, 0])
        came = self._mix(before_m, after_m, np.asarray(seen_m), apart_s)
        self._scale2 += SCALE2_PER_M * moved_m
        self._lag2 += self._path_m2_per_m * moved_m
        gains = self._correct(OUTLIERS / reach_m2)
        believed = float(np.log(came @ np.exp(gains - gains.max()))) + float(gains.max())
        unrelated = min(chance - np.log(reach_m2), believed + MAX_CHANCE)
        gains = np.append(gains, unrelated)
        weights = np.append(came, self._weights[-1]) * np.exp(gains - gains.max())
        self._weights = weights / weights.sum()
        self._doubt_mirrored(*np.abs((after_m - before_m)[:, 0]))
        self._raise(IMPOSSIBLE)
        self._renew()
        if unrelated - believed > SURPRISE:
            self._spread(AFTER_JUMP)

    def _doubt_mirrored(self, along_m: float, across_m: float) -> None:
        """Straight ahead a mirrored picture moves like any other: only what goes sideways speaks for it."""
        if across_m <= along_m:
            place = _PLACE[Lie.MIRRORED]
            self._weights[place] = min(self._weights[place], UNLIKELY)

    def _spread(self, share: float) -> None:
        """Pictures may no longer follow from those before: any delay may have come about, and any of the
        lies."""
        self.interrupted()
        known = self._weights[:_ALL].sum()
        self._weights[:_ALL] *= 1 - share
        self._weights[:_N] += share * (1 - LIES_THEN) * known / _N
        self._weights[_N:_ALL] += share * LIES_THEN * known / (_ALL - _N)

    def _mix(self, before_m: Floats, after_m: Floats, seen_m: Floats, apart_s: float) -> Floats:
        """Carry all hypotheses along, those of neighbouring delays mixed; their weights, shape (all,)."""
        passes = min(0.25, DRIFT_S2_PER_S * apart_s / (2 * STEP_S**2))
        weights = np.array([[passes], [1 - 2 * passes], [passes]]) * self._weights[_FROM]
        came = weights.sum(axis=0)
        share = weights / came
        still = np.broadcast_to(before_m[:, :1], (2, _ALL - _N))
        away = still + SIGNS * (after_m - before_m)[:, :1]
        before, after = np.concatenate([before_m, still], axis=1), np.concatenate([after_m, away], axis=1)
        said = after[:, None] - before[:, _FROM]
        scale, both = self._scale[:, _FROM], self._both[:, _FROM]
        scale2, lag2 = self._scale2[:, _FROM], self._lag2[:, _FROM]
        lag = self._lag[:, _FROM] + scale * said - seen_m[:, None, None]
        lag2 = lag2 + 2 * said * both + said**2 * scale2
        both = both + said * scale2
        self._scale, self._lag = (share * scale).sum(axis=1), (share * lag).sum(axis=1)
        off_scale, off_lag = scale - self._scale[:, None], lag - self._lag[:, None]
        self._scale2 = (share * (scale2 + off_scale**2)).sum(axis=1)
        self._both = (share * (both + off_scale * off_lag)).sum(axis=1)
        self._lag2 = (share * (lag2 + off_lag**2)).sum(axis=1)
        return np.asarray(came)

    def _correct(self, outlier_per_m2: float) -> Floats:
        """The lag was none but for the shaking; the logarithms of how likely that was, shape (all,).

        One pair of pictures may be taken wrongly, for plants a plant's spacing apart: it then corrects
        little, and speaks little against any hypothesis.
        """
        expected = self._lag2 + self._shaking_m2
        fits = np.exp((-0.5 * (self._lag**2 / expected + np.log(2 * np.pi * expected))).sum(axis=0))
        share = fits / (fits + outlier_per_m2)
        gain_scale, gain_lag = share * self._both / expected, share * self._lag2 / expected
        self._scale = (self._scale - gain_scale * self._lag).clip(MIN_SCALE, MAX_SCALE)
        self._scale2 = self._scale2 - gain_scale * self._both
        self._lag = self._lag - gain_lag * self._lag
        self._both, self._lag2 = self._both * (1 - gain_lag), self._lag2 * (1 - gain_lag)
        return np.asarray(np.log(fits + outlier_per_m2))

    def _renew(self) -> None:
        """What is next to impossible begins anew, with the scale that is believed in."""
        low: NDArray[np.bool_] = self._weights[:_ALL] < 100 * IMPOSSIBLE
        weights = self._weights[:_N] / self._weights[:_N].sum()
        scale = (self._scale[:, :_N] * weights).sum(axis=1, keepdims=True)
        self._scale[:, low], self._scale2[:, low] = scale, OTHER_SCALE_SD**2
        self._lag[:, low], self._both[:, low] = 0.0, 0.0
        self._lag2[:, low] = self._shaking_m2

    def _raise(self, least: float) -> None:
        """No lie becomes less likely than that, nor all delays together."""
        self._weights = np.maximum(self._weights, np.where(np.arange(_ALL + 1) < _N, least / _N, least))
        self._weights /= self._weights.sum()
