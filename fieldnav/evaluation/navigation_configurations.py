"""The ways to drive that `bench navigation` compares: the default, the paper's, and one between."""

from enum import Enum
from typing import Any

from fieldnav.settings.crop import ControlLaw, CropProfile, RowFinder
from fieldnav.settings.loading import revised


class Configuration(Enum):
    """A finder of rows and a control law."""

    DEFAULT = "default"
    PAPER_FINDER = "paper's finder"
    PAPER = "paper's finder and control"


def configured(crop: CropProfile, configuration: Configuration) -> CropProfile:
    """The crop profile, to be driven that way; nothing else in it is changed."""
    if configuration is Configuration.DEFAULT:
        return crop
    finder = {"method": RowFinder.MOVING_VARIANCE.value}
    changed = _with(crop, "finding", finder)
    if configuration is Configuration.PAPER_FINDER:
        return changed
    return _with(changed, "control", {"law": ControlLaw.PAPER.value})


def _with(crop: CropProfile, section: str, changes: dict[str, Any]) -> CropProfile:
    document = getattr(crop, section).model_dump(mode="json")
    return revised(crop, {section: document | changes})
