"""The pictures and sequences on which rows were once found wrongly, each with its right answer.

A picture is known by how its name begins. The right answers are those of the folder's README. Where it names
one number of rows, one more or one fewer is right too: the outermost row may lie half in the picture.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

import numpy as np

from drivers.picture_folder import PICTURES, pictures_in
from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Figure, LeftOut, Plan, Progress, Report, one_by_one
from fieldnav.evaluation.found_rows import Finder, FoundRows
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.sideways import WITHIN, judge
from fieldnav.messages import Image, Side
from fieldnav.perception.counting.row_count import Passage, RowCount
from fieldnav.perception.counting.row_counter import RowCounter
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop, load_robot, revised

PART = PhotographSet.ROW_FAULTS.title
ALL = "row faults: all"
ALL_METRIC = "right answers (share)"
QUICK_STEP = 10
"""A quick run takes one case in so many."""

MID_HEIGHT = 0.5
PROFILE_SUFFIX = ".yaml"
Answer = TypeVar("Answer")


@dataclass(frozen=True, slots=True)
class RightRows:
    """How many rows a picture may be said to show.

    bare: where no row may run, from left to right at mid-height, as shares of the width; None for nowhere.
    """

    fewest: int
    most: int
    bare: tuple[float, float] | None = None

    def __str__(self) -> str:
        number = f"{self.fewest} to {self.most}" if self.fewest < self.most else str(self.most)
        number = "no row" if self.most == 0 else f"{number} row{'' if self.most == 1 else 's'}"
        if self.bare is None:
            return number
        return f"{number}, none from {self.bare[0]:g} to {self.bare[1]:g} of the width"

    def is_given_by(self, found: FoundRows, image: Image) -> bool:
        """Whether the rows found are a right answer."""
        if not self.fewest <= len(found.lines) <= self.most:
            return False
        if self.bare is None:
            return True
        height, width = image.shape[:2]
        y = MID_HEIGHT * (height - 1)
        places = [float(np.interp(y, path[:, 1], path[:, 0])) / width for path in found.paths_px]
        return not any(self.bare[0] <= place <= self.bare[1] for place in places)


@dataclass(frozen=True, slots=True)
class RightCount:
    """A sequence that passes one row, from frame `frame` on, while the robot moves right.

    crop, robot: what the counter is told: a profile's name, or a file beside the sequence; None for nothing.
    """

    frame: int
    crop: str | None = None
    robot: str | None = None

    def __str__(self) -> str:
        told = ", ".join(name for name in (self.crop, self.robot) if name) or "nothing"
        return f"1 row counted, at frame {self.frame} +- {WITHIN}, {told} given"

    def is_given_by(self, counted: RowCount) -> bool:
        """Whether one row was counted, and at about the right frame."""
        judged = judge(counted, RowCount((Passage(self.frame, 0, Side.RIGHT),), Side.RIGHT))
        return judged.error == 0 and judged.in_time == judged.true


NONE = RightRows(0, 0)
RIGHT_ROWS: dict[str, RightRows] = {
    "f01_": RightRows(6, 8),
    "f01b_": RightRows(4, 7),  # the lower two thirds of f01_; its outer rows barely enter it
    "f02": RightRows(5, 7),
    "f03": RightRows(5, 7),
    "f04": RightRows(4, 6),
    "f05_crdld131": RightRows(0, 6, bare=(0.0, 0.25)),  # thin rows of seedlings lie beside the verge
    "f05_crdld135": RightRows(0, 6, bare=(0.75, 1.0)),
    "f05b": NONE,
    "f06": RightRows(2, 6),  # up to three either side of the tramline
    "f07": RightRows(2, 4),
    "f08": RightRows(3, 5),
    "f09": RightRows(2, 4),
    "f12": NONE,
    "f13": RightRows(4, 6),
    "f14": RightRows(4, 6),
    "f15": RightRows(5, 12),  # so many beds reach the lower edge
    "f16": RightRows(5, 7),
    "f17": RightRows(1, 1, bare=(0.6, 1.0)),
    "f18": NONE,
    "f19": NONE,
    "f20": NONE,
}
"""By how a picture's name begins; of several the longest."""

RIGHT_COUNTS: dict[str, tuple[RightCount, ...]] = {
    "f10": (RightCount(14), RightCount(14, "soy76.yaml", "vmaize.yaml")),
    "f11": (RightCount(40, "maize"), RightCount(40, "maize", "vmaize.yaml")),
}
"""By how the name of a sequence's folder begins."""


class _Case(Protocol):
    """Something to be looked at that has a right answer."""

    @property
    def path(self) -> Path: ...

    @property
    def right(self) -> RightRows | RightCount: ...

    def is_right(self, find: Finder) -> bool:
        """Whether the answer given now is right. Raises SettingsError."""
        ...


@dataclass(frozen=True, slots=True)
class _PictureCase:
    path: Path
    right: RightRows

    def is_right(self, find: Finder) -> bool:
        image = read_photograph(self.path)
        return self.right.is_given_by(find(image, None).sure(), image)


@dataclass(frozen=True, slots=True)
class _SequenceCase:
    path: Path
    right: RightCount

    def is_right(self, find: Finder) -> bool:
        first, *rest = pictures_in(self.path)
        image = read_photograph(first)
        size_px = (image.shape[1], image.shape[0])
        counter = RowCounter(self._crop(), self._camera(size_px))
        counter.add(image)
        for path in rest:
            counter.add(read_photograph(path, size_px))
        return self.right.is_given_by(counter.result(Side.RIGHT))

    def _crop(self) -> CropProfile | None:
        return None if self.right.crop is None else load_crop(self._beside(self.right.crop))

    def _camera(self, size_px: tuple[int, int]) -> Pinhole | None:
        """The robot's front camera as if its pictures had this size: the field of view stays."""
        if self.right.robot is None:
            return None
        camera = load_robot(self._beside(self.right.robot)).cameras.front
        return revised(camera, {"width_px": size_px[0], "height_px": size_px[1]}, str(self.path)).pinhole()

    def _beside(self, name: str) -> str:
        return str(self.path.parent / name) if name.endswith(PROFILE_SUFFIX) else name


def row_faults(plan: Plan, progress: Progress, find: Finder) -> Report:
    """A figure a picture or sequence, 1 for a right answer, and one of all. Raises SettingsError."""
    folder = PhotographSet.ROW_FAULTS.folder(plan)
    if folder is None:
        return Report((), (PhotographSet.ROW_FAULTS.absence(plan),))
    inputs = {path: _cases_of(path) for path in _inputs_in(folder)}
    left_out = [
        LeftOut(PART, f"of {path.name} no right answer is known") for path in inputs if not inputs[path]
    ]
    cases = [case for of_input in inputs.values() for case in of_input][:: QUICK_STEP if plan.quick else 1]
    if not cases:
        return Report((), (*left_out, LeftOut(PART, f"{folder} holds no picture with a known right answer")))
    right = [float(case.is_right(find)) for case in one_by_one(PART, cases, progress)]
    figures = [
        Figure(f"row faults: {case.path.name}", f"right (1) or wrong (0): {case.right}", value, goal=1.0)
        for case, value in zip(cases, right, strict=True)
    ]
    return Report((*figures, Figure(ALL, ALL_METRIC, float(np.mean(right)), goal=1.0)), tuple(left_out))


def _inputs_in(folder: Path) -> list[Path]:
    """The pictures and the folders of pictures in a folder, by name. Raises SettingsError."""
    try:
        paths = sorted(path for path in folder.iterdir() if not path.name.startswith("."))
        return [path for path in paths if (pictures_in(path) if path.is_dir() else _is_picture(path))]
    except OSError as error:
        raise SettingsError(f"{folder}: cannot be read: {error.strerror}") from error


def _is_picture(path: Path) -> bool:
    return path.suffix.lower() in PICTURES


def _cases_of(path: Path) -> list[_Case]:
    """What is to be asked about a picture or a folder of pictures; nothing where no right answer is known."""
    if path.is_dir():
        return [_SequenceCase(path, right) for right in _answer(path.name, RIGHT_COUNTS) or ()]
    rows = _answer(path.name, RIGHT_ROWS)
    return [] if rows is None else [_PictureCase(path, rows)]


def _answer(name: str, answers: Mapping[str, Answer]) -> Answer | None:
    """The answer under the longest beginning of the name."""
    beginnings = [beginning for beginning in answers if name.startswith(beginning)]
    return answers[max(beginnings, key=len)] if beginnings else None
