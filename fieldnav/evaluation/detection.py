"""The benchmark of detection: rows of real photographs, of the paper's protocol, and where there are none."""

from fieldnav.evaluation.benchmark import Plan, Progress, Report
from fieldnav.evaluation.cross_set import cross_set
from fieldnav.evaluation.found_rows import FoundRows
from fieldnav.evaluation.photographed_rows import photographed_rows
from fieldnav.evaluation.rendered_rows import rendered_rows
from fieldnav.evaluation.row_faults import row_faults
from fieldnav.evaluation.rowless import rowless
from fieldnav.evaluation.rowless_photographs import rowless_photographs
from fieldnav.evaluation.sideways import sideways
from fieldnav.messages import Image
from fieldnav.perception.unposed import find_unposed
from fieldnav.settings.crop import CropProfile


def detection(plan: Plan, progress: Progress) -> Report:
    """Every figure of detection. Raises SettingsError, OutputError."""
    of_photographs = [
        photographed_rows(plan, progress, unposed_rows),
        rowless_photographs(plan, progress, unposed_rows),
        row_faults(plan, progress, unposed_rows),
        cross_set(plan, progress),
        sideways(plan, progress),
    ]
    figures = [figure for report in of_photographs for figure in report.figures]
    left_out = [part for report in of_photographs for part in report.left_out]
    return Report((*figures, *rendered_rows(plan, progress), *rowless(plan, progress)), tuple(left_out))


def unposed_rows(image: Image, crop: CropProfile | None) -> FoundRows:
    """The rows of a picture whose camera is not known, as fieldnav finds them."""
    view = find_unposed(image, crop).view
    return FoundRows(view.lines, view.paths_px)
