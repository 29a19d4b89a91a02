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
from fieldnav.evaluation.judged_candidates import JudgedPicture, Truth, judged_picture, worth_of
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.rowless_photographs import KINDS, pictures_under
from fieldnav.messages import Floats, Image
from fieldnav.perception.comb.row_judge import CandidateMeasures
from fieldnav.perception.witnessed import lines_of

Case = tuple[Image, Truth]


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


def _near_nadir(plan: Plan) -> Iterator[Case]:
    for photograph in near_nadir_truth.photographs_in(_folder(PhotographSet.NEAR_NADIR, plan)):
        image = read_photograph(photograph.path)
        yield image, partial(_as_near_nadir, photograph, (image.shape[1], image.shape[0]))


def _as_near_nadir(
    photograph: near_nadir_truth.Photograph, size: tuple[int, int], measured: CandidateMeasures
) -> tuple[float, Floats]:
    lines = lines_of(measured.candidate, np.ones(len(measured.candidate.paths_px)), size[1])
    given = (lines, photograph.rows, photograph.must_be_found, size)
    judged, tally = near_nadir_score.judge(*given), near_nadir_score.score(*given)
    right = np.where(judged.counts, (judged.true != UNMATCHED).astype(float), np.nan)
    return worth_of(right, sum(photograph.must_be_found), tally.turned_deg), right


def _crbd(plan: Plan) -> Iterator[Case]:
    for picture in crbd_truth.pictures_in(_folder(PhotographSet.CRBD, plan)):
        yield read_photograph(picture.path), partial(_as_crbd, picture.truth)


def _as_crbd(truth: crbd_truth.TrueLattice, measured: CandidateMeasures) -> tuple[float, Floats]:
    """The set's own score says how well the middle rows fit; it knows nothing of the others."""
    places = positions(measured.candidate.paths_px)
    right = (true_rows(places, truth) != UNMATCHED).astype(float)
    exact = (crda(places, truth, LOWER_HALF_PX) + crda(places, truth)) / 2
    return float(right.mean()) * exact, right


def _lincoln(plan: Plan) -> Iterator[Case]:
    for picture in lincoln.pictures_in(_folder(PhotographSet.LINCOLN, plan)):
        yield read_photograph(picture.path), partial(_as_lincoln, picture.rows)


def _as_lincoln(rows: tuple[Floats, ...], measured: CandidateMeasures) -> tuple[float, Floats]:
    paths_px = measured.candidate.paths_px
    judged, tally = lincoln_score.judge(paths_px, rows), lincoln_score.score(paths_px, rows)
    right = np.where(judged.counts, (judged.true != UNMATCHED).astype(float), np.nan)
    return worth_of(right, tally.main_rows, tally.turned_deg), right


def _rowless(plan: Plan) -> Iterator[Case]:
    for kind in KINDS:
        for path in sorted(pictures_under(_folder(PhotographSet.NO_ROWS, plan) / kind)):
            yield read_photograph(path), _as_rowless


def _as_rowless(measured: CandidateMeasures) -> tuple[float, Floats]:
    return 0.0, np.zeros(len(measured.candidate.paths_px))


def _folder(photographs: PhotographSet, plan: Plan) -> Path:
    folder = photographs.folder(plan)
    assert folder is not None, "cases_of asks for sets that are there"
    return folder
