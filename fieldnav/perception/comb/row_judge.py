"""Which of the candidates a picture shows, if any, and how sure each of its rows is.

Two logistic regressions: one over what speaks for a candidate as a whole, against all others and against no
row at all; one over what speaks for each of its rows once it has been chosen. Their weights stand in
`row_judge.json`. They were fitted to the photographs of the benchmark of detection
(`fieldnav.training.row_judge`), unlike the network.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from math import log

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from fieldnav.messages import Floats
from fieldnav.perception.comb.candidates import Candidate, Source
from fieldnav.perception.comb.confidence import LEAST_STAND
from fieldnav.perception.comb.finder import OBLIQUE
from fieldnav.perception.comb.row_contrast import (
    ALMOST_NOTHING,
    PlacedRows,
    RowContrast,
    agreement,
    contrast_of,
    explained,
    placed,
)
from fieldnav.perception.row_network import FULL, RowHeat
from fieldnav.perception.vegetation import Cover

LEAST_CHANCE, LEAST_HEAT = 1e-4, 0.003
NO_ROW = 0.0  # log odds of there being no row at all
SURE, SAME = 0.98, 0.85
"""Confidence of vegetation alone, and agreement with the candidate chosen, from which on its places count."""
NEAR_SURE, NEAR_SAME = 0.88, 0.8
"""The same in a view that looks ahead, of rows seen nearby and carried on straight: they may bend."""
PAIR, NONE_SEEN = 2, 0.5
BY_VEGETATION = {Source.VEGETATION, Source.NEAR_VEGETATION}


class Regression(BaseModel):
    """A logistic regression: weights of standardised features, in the features' order."""

    model_config = ConfigDict(frozen=True, extra="forbid")
    mean: tuple[float, ...]
    deviation: tuple[float, ...]
    weight: tuple[float, ...]
    intercept: float

    def log_odds(self, features: Floats) -> Floats:
        """Shape (n,) for features of shape (n, weights)."""
        standard = (features - np.array(self.mean)) / np.array(self.deviation)
        return np.asarray(standard @ np.array(self.weight) + self.intercept)

    def probability(self, features: Floats) -> Floats:
        """The same as probabilities."""
        return np.asarray(1 / (1 + np.exp(-self.log_odds(features))))


class RowJudge(BaseModel):
    """Both regressions."""

    model_config = ConfigDict(frozen=True, extra="forbid")
    candidate: Regression
    row: Regression


@dataclass(frozen=True, slots=True)
class CandidateMeasures:
    """What both witnesses say of one candidate.

    agreement: with the candidates of the other kind; surest: how sure vegetation by itself is of any of them.
    """

    candidate: Candidate
    rows: PlacedRows
    vegetation: RowContrast
    network: RowContrast
    explained: float
    heat: float
    field: float
    agreement: float
    surest: float

    def features(self) -> Floats:
        """What speaks for or against the candidate, shape (features,)."""
        seen = self.rows.seen
        count = int(seen.sum())
        leans = np.abs(self.rows.place[:, -1] - self.rows.place[:, 0])
        gaps = np.diff(self.rows.place[:, len(self.rows.spacing) // 2])
        unevenness = float(gaps.std() / max(abs(gaps.mean()), LEAST_HEAT)) if len(gaps) > 1 else 0.0
        both = [_summary(each, seen) for each in (self.vegetation, self.network)]
        (_, green_contrast, _, green_even, _), (warm, warm_contrast, _, warm_even, _) = both
        lone = float(count <= 1)
        sure = _log_odds(self.candidate.sure) if self.candidate.source in BY_VEGETATION else 0.0
        return np.array(
            [
                *both[0],
                *both[1],
                self.vegetation.width,
                self.network.width,
                green_contrast * warm_contrast,
                min(green_even, warm_even),
                lone * warm_contrast,
                self.agreement * warm,
                self.agreement,
                _log_odds(self.field),
                self.explained,
                log(self.heat + LEAST_HEAT),
                self.candidate.convergence,
                float(leans.min()),
                unevenness,
                lone,
                float(count == PAIR),
                log(max(count, NONE_SEEN)),
                self.candidate.rows_across,
                sure,
                sure * self.agreement,
                sure * self.field,
                _log_odds(self.surest),
                *(float(self.candidate.source is source) for source in Source),
            ]
        )

    @property
    def stand(self) -> Floats:
        """How much each row shows beyond what lies beside it, against the middle one, shape (rows,).

        By the witness that shows more of it.
        """
        by_each = [np.maximum(each.on - each.between, 0) for each in (self.vegetation, self.network)]
        usual = [max(float(np.median(each)), ALMOST_NOTHING) for each in by_each]
        return np.maximum(by_each[0] / usual[0], by_each[1] / usual[1])

    def row_features(self, log_odds: float) -> Floats:
        """What speaks for each of its rows, shape (rows, features); log_odds: those of the candidate."""
        whole = np.full(len(self.vegetation.on), log_odds)
        lone = np.full(len(whole), float(self.rows.seen.sum() <= 1))
        green, warm = self.vegetation, self.network
        columns = (whole, green.contrast, green.evenness, warm.on, warm.contrast, warm.evenness, lone)
        return np.stack(columns, axis=-1)


@dataclass(frozen=True, slots=True)
class ChosenRows:
    """The candidate chosen and the probability that each of its rows is one, shape (rows,)."""

    candidate: Candidate
    confidence: Floats


def measure(candidates: Sequence[Candidate], cover: Cover, heat: RowHeat) -> list[CandidateMeasures]:
    """What both witnesses say of each candidate."""
    green = np.asarray(cover.strength / np.float32(FULL), np.float32)
    warm = heat.spread
    rows = [placed(each, cover.width_px, cover.height_px) for each in candidates]
    surest = max((each.sure for each in candidates), default=0.0)
    return [
        CandidateMeasures(
            each,
            own,
            contrast_of(own, green),
            contrast_of(own, warm),
            explained(own, warm),
            float(warm[len(warm) // 3 :].mean()),
            heat.field,
            _agreement(number, candidates, rows),
            surest,
        )
        for number, (each, own) in enumerate(zip(candidates, rows, strict=True))
    ]


def choose_rows(measured: Sequence[CandidateMeasures], judge: RowJudge) -> ChosenRows | None:
    """The candidate with the highest odds; None where none of them is as likely as no row at all."""
    if not measured:
        return None
    odds = judge.candidate.log_odds(np.stack([each.features() for each in measured]))
    best = int(odds.argmax())
    if odds[best] < NO_ROW:
        return None
    exact = _more_exact(measured, measured[best])
    likely = judge.row.probability(exact.row_features(float(odds[best])))
    return ChosenRows(exact.candidate, np.asarray(likely * np.minimum(exact.stand / LEAST_STAND, 1)))


def _more_exact(measured: Sequence[CandidateMeasures], chosen: CandidateMeasures) -> CandidateMeasures:
    """The same rows as vegetation alone shows them, where it is sure of them: its places are more exact."""
    near = chosen.candidate.source is Source.NEAR_VEGETATION and chosen.candidate.convergence >= OBLIQUE
    least_sure, alike = (NEAR_SURE, NEAR_SAME) if near else (SURE, SAME)
    same = [
        each
        for each in measured
        if each.candidate.source is Source.VEGETATION
        and each.candidate.sure >= least_sure
        and agreement(chosen.rows, each.rows) >= alike
    ]
    return max(same, key=lambda each: each.candidate.sure, default=chosen)


@lru_cache(maxsize=1)
def row_judge() -> RowJudge:
    """The judge as it was fitted."""
    return RowJudge.model_validate_json(files(__package__).joinpath("row_judge.json").read_bytes())


def _log_odds(probability: float) -> float:
    return log((probability + LEAST_CHANCE) / (1 - probability + LEAST_CHANCE))


def _summary(rows: RowContrast, seen: NDArray[np.bool_]) -> tuple[float, float, float, float, float]:
    """On the rows seen: strength, contrast, weakest contrast, evenness; and strength between."""
    if not seen.any():
        return 0.0, 0.0, -1.0, 0.0, 0.0
    contrast = rows.contrast[seen]
    return (
        float(rows.on[seen].mean()),
        float(contrast.mean()),
        float(contrast.min()),
        float(rows.evenness[seen].mean()),
        float(rows.between[seen].mean()),
    )


def _agreement(number: int, candidates: Sequence[Candidate], rows: Sequence[PlacedRows]) -> float:
    """The best with any candidate of the other kind: of vegetation alone, or of both witnesses."""
    alone = candidates[number].source in BY_VEGETATION
    others = [at for at, each in enumerate(candidates) if (each.source in BY_VEGETATION) != alone]
    return max((agreement(rows[number], rows[other]) for other in others), default=0.0)
