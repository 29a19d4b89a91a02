"""The benchmark of detection: rows of real photographs, of the paper's protocol, and where there are none."""

from fieldnav.evaluation.benchmark import Plan, Progress, Report
from fieldnav.evaluation.found_rows import FoundRows
from fieldnav.evaluation.photographed_rows import photographed_rows
from fieldnav.evaluation.rendered_rows import rendered_rows
from fieldnav.evaluation.rowless import rowless
from fieldnav.evaluation.sideways import sideways
from fieldnav.messages import Image
from fieldnav.perception.unposed import find_unposed
from fieldnav.settings.crop import CropProfile


def detection(plan: Plan, progress: Progress) -> Report:
    """Every figure of detection. Raises SettingsError, OutputError."""
    photographed = photographed_rows(plan, progress, unposed_rows)
    passing = sideways(plan, progress)
    figures = (
        *photographed.figures,
        *passing.figures,
        *rendered_rows(plan, progress),
        *rowless(plan, progress),
    )
    return Report(figures, (*photographed.left_out, *passing.left_out))


def unposed_rows(image: Image, crop: CropProfile | None) -> FoundRows:
    """The rows of a picture whose camera is not known, as fieldnav finds them."""
    view = find_unposed(image, crop).view
    return FoundRows(view.lines, view.paths_px)
