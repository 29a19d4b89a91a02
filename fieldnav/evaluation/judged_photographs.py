"""What perception might see in each photograph with known rows, or with none, and what of it is true."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import cv2
import numpy as np

from fieldnav.evaluation import crbd_truth, lincoln, lincoln_score, near_nadir_score, near_nadir_truth
from fieldnav.evaluation.benchmark import Plan
from fieldnav.evaluation.crbd_score import LOWER_HALF_PX, crda, positions, true_rows
from fieldnav.evaluation.found_rows import UNMATCHED
from fieldnav.evaluation.judge_fit import JudgedCandidate, JudgedPicture
from fieldnav.evaluation.near_nadir import ALIKE_DEG
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.rowless_photographs import KINDS, pictures_under
from fieldnav.messages import Floats, Image
from fieldnav.perception.comb.candidates import Candidate, candidates_in
from fieldnav.perception.comb.row_judge import accounts_of
from fieldnav.perception.comb.search_range import any_camera
from fieldnav.perception.row_network import look
from fieldnav.perception.vegetation import vegetation_of
from fieldnav.perception.witnessed import lines_of
from fieldnav.settings.crop import Vegetation

Truth = Callable[[Candidate], tuple[float, Floats]]
"""What a candidate is worth, and which of its rows are right, as in JudgedCandidate."""
Case = tuple[Image, Truth]
ALIKE_WORTH = 0.3
"""Of the worth of rows, that their right direction counts."""


def judged_picture(image: Image, truth: Truth) -> JudgedPicture:
    """Every candidate of a picture, of a camera and a crop that nobody knows."""
    vegetation = Vegetation()
    cover, heat = vegetation_of(image, vegetation), look(image)
    candidates = candidates_in(image, cover, heat, any_camera(None), vegetation)
    return [
        JudgedCandidate(told.features(), told.row_features(0.0), *truth(told.candidate))
        for told in accounts_of(candidates, cover, heat)
    ]


def judged_cases(cases: Sequence[Case]) -> list[JudgedPicture]:
    """The same of several pictures, on one thread."""
    cv2.setNumThreads(1)
    return [judged_picture(*case) for case in cases]


def cases_of(plan: Plan) -> dict[str, list[Case]]:
    """Every photograph there is, by its set. Raises SettingsError."""
    readers: dict[PhotographSet, Callable[[Plan], Iterator[Case]]] = {
        PhotographSet.NEAR_NADIR: _near_nadir,
        PhotographSet.CRBD: _crbd,
        PhotographSet.LINCOLN: _lincoln,
        PhotographSet.NO_ROWS: _rowless,
    }
    return {each.title: list(read(plan)) for each, read in readers.items() if each.folder(plan) is not None}


def worth_of(right: Floats, must_be_found: int, turned_deg: Floats) -> float:
    """The harmonic mean of precision and recall, less where rows that are right have a wrong direction."""
    hits, wrong = int((right == 1).sum()), int((right == 0).sum())
    alike = float(np.mean(turned_deg < ALIKE_DEG)) if len(turned_deg) else 0.0
    f1 = 2 * hits / max(hits + wrong + must_be_found, 1)
    return min(f1, 1.0) * (1 - ALIKE_WORTH * (1 - alike))


def _near_nadir(plan: Plan) -> Iterator[Case]:
    for photograph in near_nadir_truth.photographs_in(_folder(PhotographSet.NEAR_NADIR, plan)):
        image = read_photograph(photograph.path)
        yield image, partial(_as_near_nadir, photograph, (image.shape[1], image.shape[0]))


def _as_near_nadir(
    photograph: near_nadir_truth.Photograph, size: tuple[int, int], candidate: Candidate
) -> tuple[float, Floats]:
    lines = lines_of(candidate, np.ones(len(candidate.paths_px)), size[1])
    given = (lines, photograph.rows, photograph.must_be_found, size)
    judged, tally = near_nadir_score.judge(*given), near_nadir_score.score(*given)
    right = np.where(judged.counts, (judged.true != UNMATCHED).astype(float), np.nan)
    return worth_of(right, sum(photograph.must_be_found), tally.turned_deg), right


def _crbd(plan: Plan) -> Iterator[Case]:
    for picture in crbd_truth.pictures_in(_folder(PhotographSet.CRBD, plan)):
        yield read_photograph(picture.path), partial(_as_crbd, picture.truth)


def _as_crbd(truth: crbd_truth.TrueLattice, candidate: Candidate) -> tuple[float, Floats]:
    """The set's own score says how well the middle rows fit; it knows nothing of the others."""
    places = positions(candidate.paths_px)
    right = (true_rows(places, truth) != UNMATCHED).astype(float)
    return float(right.mean()) * crda(places, truth, LOWER_HALF_PX), right


def _lincoln(plan: Plan) -> Iterator[Case]:
    for picture in lincoln.pictures_in(_folder(PhotographSet.LINCOLN, plan)):
        yield read_photograph(picture.path), partial(_as_lincoln, picture.rows)


def _as_lincoln(rows: tuple[Floats, ...], candidate: Candidate) -> tuple[float, Floats]:
    judged = lincoln_score.judge(candidate.paths_px, rows)
    tally = lincoln_score.score(candidate.paths_px, rows)
    right = np.where(judged.counts, (judged.true != UNMATCHED).astype(float), np.nan)
    return worth_of(right, tally.main_rows, tally.turned_deg), right


def _rowless(plan: Plan) -> Iterator[Case]:
    for kind in KINDS:
        for path in sorted(pictures_under(_folder(PhotographSet.NO_ROWS, plan) / kind)):
            yield read_photograph(path), _as_rowless


def _as_rowless(candidate: Candidate) -> tuple[float, Floats]:
    return 0.0, np.zeros(len(candidate.paths_px))


def _folder(photographs: PhotographSet, plan: Plan) -> Path:
    folder = photographs.folder(plan)
    assert folder is not None, "cases_of asks for sets that are there"
    return folder
