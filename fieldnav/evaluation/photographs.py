"""Where the photographs with ground truth lie, and how one of them is read."""

from enum import Enum
from pathlib import Path

import cv2
import numpy as np

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import LeftOut, Plan
from fieldnav.messages import Image
from fieldnav.settings.regular_file import read_regular

LARGEST_BYTES = 2**26
"""Of one photograph or one file of ground truth; the largest known has less than one megabyte."""


class PhotographSet(Enum):
    """The sets, by the folder that each lies in."""

    NEAR_NADIR = "near_nadir_jw"
    CRBD = "crbd"

    @property
    def title(self) -> str:
        return TITLES[self]

    def folder(self, plan: Plan) -> Path | None:
        """Where this set lies; None where it is absent."""
        folder = None if plan.data is None else plan.data / self.value
        return folder if folder is not None and folder.is_dir() else None

    def absence(self, plan: Plan) -> LeftOut:
        """Why this set is left out, for a plan in which it is absent."""
        if plan.data is None:
            return LeftOut(self.title, "no folder of photographs given: --data DIR or FIELDNAV_DATA names it")
        return LeftOut(self.title, f"there is no folder {plan.data / self.value}")


TITLES = {
    PhotographSet.NEAR_NADIR: "photographs near the robot's view",
    PhotographSet.CRBD: "Crop Row Benchmark Dataset",
}


def read_photograph(path: Path) -> Image:
    """The picture in a file, shape (height, width, 3), blue green red. Raises SettingsError."""
    content = np.frombuffer(read_regular(str(path), LARGEST_BYTES), np.uint8)
    image = cv2.imdecode(content, cv2.IMREAD_COLOR) if len(content) else None
    if image is None:
        raise SettingsError(f"{path}: is no whole picture; allowed is JPEG or PNG")
    return np.asarray(image, dtype=np.uint8)


def read_words(path: Path) -> str:
    """The text of a file. Raises SettingsError."""
    try:
        return read_regular(str(path), LARGEST_BYTES).decode("utf-8")
    except UnicodeDecodeError as error:
        raise SettingsError(f"{path}: is no UTF-8 text; allowed is a text file") from error
