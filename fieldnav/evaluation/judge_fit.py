"""The judge of rows, fitted to candidates whose truth is known and tried on others."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from scipy.optimize import minimize

from fieldnav.evaluation.found_rows import LEAST_CONFIDENCE
from fieldnav.evaluation.judged_candidates import JudgedCandidate, JudgedPicture
from fieldnav.evaluation.reliability import JudgedRows
from fieldnav.messages import Floats
from fieldnav.perception.comb.row_judge import NO_ROW, Regression, RowJudge

PENALTY = 3.0  # on the squares of the weights
MAX_ROUNDS = 1000
ALMOST_NOTHING = 1e-9
LEAST_WORTH = 1e-3  # so that a picture that cannot be judged right does not count without end


def fit_judge(pictures: Sequence[JudgedPicture]) -> RowJudge:
    """Both regressions, the second on the rows of the candidates that the first chooses."""
    candidate = fit_choice(pictures)
    chosen = [each for each in (_chosen(picture, candidate) for picture in pictures) if each is not None]
    of_all = np.concatenate([of_rows for _, of_rows in chosen])
    told = np.concatenate([best.right for best, _ in chosen])
    known = np.isfinite(told)
    return RowJudge(candidate=candidate, row=fit_regression(of_all[known], told[known]))


def fit_choice(pictures: Sequence[JudgedPicture]) -> Regression:
    """A regression whose choice is worth as much as can be, over all pictures that have candidates.

    A candidate is chosen with a probability that grows as the exponential of its log odds, none with that of
    0. None is worth what the best candidate lacks: everything where no candidate shows a row that is there.
    """
    shown = list(filter(None, pictures))
    features = np.array([each.features for picture in shown for each in picture])
    worth = np.array([each.worth for picture in shown for each in picture])
    of_picture = np.repeat(np.arange(len(shown)), [len(picture) for picture in shown])
    none_worth = 1 - np.array([max(each.worth for each in picture) for picture in shown])
    first = fit_regression(features, worth)
    design = np.column_stack([(features - first.mean) / first.deviation, np.ones(len(features))])
    penalised = _penalties(design)

    def loss(weights: Floats) -> tuple[float, Floats]:
        odds = design @ weights
        highest = np.zeros(len(shown))
        np.maximum.at(highest, of_picture, odds)
        some, none = np.exp(odds - highest[of_picture]), np.exp(-highest)
        total = none + np.bincount(of_picture, some)
        expected = (none * none_worth + np.bincount(of_picture, some * worth)) / total
        cost = -np.log(expected + LEAST_WORTH).sum() + penalised @ weights**2 / 2
        gain = (some / total[of_picture]) * (worth - expected[of_picture])
        slope = -design.T @ (gain / (expected + LEAST_WORTH)[of_picture]) + penalised * weights
        return float(cost), np.asarray(slope)

    return _regression(first.mean, first.deviation, _least(loss, np.append(first.weight, first.intercept)))


def fit_regression(features: Floats, target: Floats) -> Regression:
    """Logistic regression of a target from 0 to 1, shape (n,), on features, shape (n, m)."""
    mean, deviation = features.mean(axis=0), features.std(axis=0) + ALMOST_NOTHING
    design = np.column_stack([(features - mean) / deviation, np.ones(len(features))])
    penalised = _penalties(design)

    def loss(weights: Floats) -> tuple[float, Floats]:
        odds = design @ weights
        likely = 1 / (1 + np.exp(-odds))
        cost = np.logaddexp(0, odds) - target * odds
        slope = design.T @ (likely - target) + penalised * weights
        return float(cost.sum() + penalised @ weights**2 / 2), np.asarray(slope)

    return _regression(mean, deviation, _least(loss, np.zeros(design.shape[1])))


def judged_rows(pictures: Sequence[JudgedPicture], judge: RowJudge) -> JudgedRows:
    """The rows of the candidates that a judge chooses: its confidence, and whether they are right."""
    chosen = (_chosen(picture, judge.candidate) for picture in pictures)
    return JudgedRows.joined(_judged(*each, judge.row) for each in chosen if each is not None)


def reported(picture: JudgedPicture, judge: RowJudge) -> bool:
    """Whether a judge reports any row of a picture."""
    chosen = _chosen(picture, judge.candidate)
    return chosen is not None and bool((judge.row.probability(chosen[1]) >= LEAST_CONFIDENCE).any())


def left_out(sets: Mapping[str, Sequence[JudgedPicture]], name: str) -> RowJudge:
    """A judge that is fitted to every set but one."""
    return fit_judge([picture for title, of_set in sets.items() if title != name for picture in of_set])


def _penalties(design: Floats) -> Floats:
    """Of each weight's square; the last one is the intercept."""
    return np.append(np.full(design.shape[1] - 1, PENALTY), 0.0)


def _least(loss: Callable[[Floats], tuple[float, Floats]], start: Floats) -> Floats:
    """The weights with the least loss, which comes with its slope."""
    found = minimize(loss, start, jac=True, method="L-BFGS-B", options={"maxiter": MAX_ROUNDS})
    return np.asarray(found.x)


def _regression(
    mean: Floats | Sequence[float], deviation: Floats | Sequence[float], found: Floats
) -> Regression:
    return Regression(
        mean=tuple(map(float, mean)),
        deviation=tuple(map(float, deviation)),
        weight=tuple(map(float, found[:-1])),
        intercept=float(found[-1]),
    )


def _judged(best: JudgedCandidate, of_rows: Floats, row: Regression) -> JudgedRows:
    known = np.isfinite(best.right)
    return JudgedRows(row.probability(of_rows)[known], np.asarray(best.right[known] == 1))


def _chosen(picture: JudgedPicture, candidate: Regression) -> tuple[JudgedCandidate, Floats] | None:
    """The candidate that is chosen, if any, and the features of its rows with its log odds in them."""
    if not picture:
        return None
    odds = candidate.log_odds(np.array([each.features for each in picture]))
    best = int(odds.argmax())
    if odds[best] < NO_ROW:
        return None
    of_rows = picture[best].row_features.copy()
    of_rows[:, 0] = odds[best]
    return picture[best], of_rows
