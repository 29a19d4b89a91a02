"""Where the photographs with ground truth lie, and how one of them is read."""

import os
from enum import Enum
from pathlib import Path
from typing import Annotated

import cv2
import numpy as np
from pydantic import Field

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import LeftOut, Plan
from fieldnav.messages import Image
from fieldnav.settings.regular_file import read_regular

LARGEST_BYTES = 2**26
"""Of one photograph or one file of ground truth; the largest known has less than one megabyte."""


FURTHEST_PX = 1e6
"""Of a true row from the picture's left edge; far beyond any that a picture shows a part of."""

Column = Annotated[float, Field(ge=-FURTHEST_PX, le=FURTHEST_PX)]
"""Where a true row meets the line of an edge of the picture, pixels."""


class PhotographSet(Enum):
    """The sets, by the folder that each lies in."""

    NEAR_NADIR = "near_nadir_jw"
    CRBD = "crbd"
    LINCOLN = "crdld"
    NO_ROWS = "no_rows"
    ROW_FAULTS = "row_faults"

    @property
    def title(self) -> str:
        return TITLES[self]

    @property
    def truth(self) -> str:
        """What holds the true rows, within the set's folder; empty for a set that needs no such file."""
        return TRUTHS.get(self, "")

    def folder(self, plan: Plan, part: str | None = None) -> Path | None:
        """Where this set lies; None where it is absent or lacks a part, if none is named its ground truth.

        Raises SettingsError for a folder that cannot be looked into.
        """
        if plan.data is None:
            return None
        folder = plan.data / self.value
        try:
            os.stat(os.path.join(folder, part or self.truth))  # ends in / without a part: no file will do
        except (FileNotFoundError, NotADirectoryError):
            return None
        except OSError as error:
            raise SettingsError(f"{folder}: cannot be read: {error.strerror}") from error
        return folder

    def absence(self, plan: Plan, part: str | None = None) -> LeftOut:
        """Why this set is left out, for a plan in which it is absent."""
        if plan.data is None:
            return LeftOut(self.title, "no folder of photographs given: --data DIR or FIELDNAV_DATA names it")
        folder = plan.data / self.value
        if not folder.is_dir():
            return LeftOut(self.title, f"there is no folder {folder}")
        return LeftOut(self.title, f"there is no {folder / (part or self.truth)}")


TITLES = {
    PhotographSet.NEAR_NADIR: "photographs near the robot's view",
    PhotographSet.CRBD: "Crop Row Benchmark Dataset",
    PhotographSet.LINCOLN: "Crop Row Detection Lincoln Dataset",
    PhotographSet.NO_ROWS: "photographs without a row",
    PhotographSet.ROW_FAULTS: "pictures in which rows were found wrongly",
}
TRUTHS = {
    PhotographSet.NEAR_NADIR: "rows.json",
    PhotographSet.CRBD: "gt",
    PhotographSet.LINCOLN: "rows.json",
}
"""What holds the true rows, within a set's folder."""


def read_photograph(path: Path, size_px: tuple[int, int] | None = None) -> Image:
    """The picture in a file, shape (height, width, 3), blue green red.

    size_px: the width and height that it must have, None for any. Raises SettingsError.
    """
    content = np.frombuffer(read_regular(str(path), LARGEST_BYTES), np.uint8)
    try:
        image = cv2.imdecode(content, cv2.IMREAD_COLOR) if len(content) else None
    except cv2.error:  # a head that claims more pixels than OpenCV allocates
        image = None
    if image is None:
        raise SettingsError(f"{path}: is no whole picture; allowed is JPEG or PNG")
    height, width = image.shape[:2]
    if size_px not in (None, (width, height)):
        raise SettingsError(f"{path}: size: {width}x{height}: allowed is {size_px[0]}x{size_px[1]}")
    return np.asarray(image, dtype=np.uint8)


def read_words(path: Path) -> str:
    """The text of a file. Raises SettingsError."""
    try:
        return read_regular(str(path), LARGEST_BYTES).decode("utf-8-sig")  # some editors mark it as UTF-8
    except UnicodeDecodeError as error:
        raise SettingsError(f"{path}: is no UTF-8 text; allowed is a text file") from error
