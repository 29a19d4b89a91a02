"""Photographs without a crop row, and the share of them in which perception reports one all the same."""

from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

from drivers.picture_folder import PICTURES
from fieldnav.evaluation.benchmark import Better, Figure, LeftOut, Plan, Progress, Report, one_by_one
from fieldnav.evaluation.found_rows import Finder
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.rendered_rows import CROPS
from fieldnav.evaluation.rowless import ROBOT, as_large, reports_row
from fieldnav.perception.perceive import find as find_with_camera
from fieldnav.settings.loading import load_crop, load_robot

UNKNOWN = "pictures in which a row is reported, camera not known (%)"
KNOWN = "pictures in which a row is reported, camera and crop given (%)"
POSE_UNKNOWN = "pictures in which a row is reported, camera and crop given, pose not exact (%)"
"""The last is what `fieldnav detect --robot` does with a picture."""
KINDS = {"photographs": "ordinary photographs", "fields": "soil, verges, stubble, sky"}
"""What the folders of the set show; each is searched with all folders in it."""

QUICK_STEP = 10
"""A quick run takes one picture in so many."""

GOAL_PERCENT, PERCENT = 2.0, 100.0
BEST_KNOWN_PERCENT = {"photographs": 3.0}
"""By folder; of the pictures of fields none is known."""

NETWORK = "a network (YOLOv5n-seg, 4 MB) at confidence 0.5, photographs of the same kind"


def rowless_photographs(plan: Plan, progress: Progress, find: Finder) -> Report:
    """Three figures a folder of the set: without a camera, with it and a crop, and with its pose not exact.

    Raises SettingsError.
    """
    photographs = PhotographSet.NO_ROWS
    if photographs.folder(plan) is None:
        return Report((), (photographs.absence(plan),))
    figures: list[Figure] = []
    left_out: list[LeftOut] = []
    for kind, shown in KINDS.items():
        folder = photographs.folder(plan, kind)
        pictures = [] if folder is None else sorted(pictures_under(folder / kind))
        if folder is None:
            left_out.append(photographs.absence(plan, kind))
        elif not pictures:
            left_out.append(LeftOut(photographs.title, f"{folder / kind} holds no picture"))
        else:
            chosen = pictures[:: QUICK_STEP if plan.quick else 1]
            figures += _figures(f"no rows: {shown}", chosen, progress, find, BEST_KNOWN_PERCENT.get(kind))
    return Report(tuple(figures), tuple(left_out))


def pictures_under(folder: Path) -> Iterator[Path]:
    """Every file that is a picture by its name; a hidden one, as memory cards hold, is none."""
    for path in folder.rglob("*"):
        if path.suffix.lower() in PICTURES and not path.name.startswith(".") and path.is_file():
            yield path


def _figures(
    kind: str, pictures: list[Path], progress: Progress, find: Finder, best_known: float | None
) -> list[Figure]:
    camera = load_robot(ROBOT).cameras.front.pinhole()
    crops = cycle([load_crop(name) for name in CROPS])
    wrong = dict.fromkeys((UNKNOWN, KNOWN, POSE_UNKNOWN), 0)
    for path in one_by_one(kind, pictures, progress):
        image, crop = read_photograph(path), next(crops)
        wrong[UNKNOWN] += bool(find(image, None).sure().lines)
        large = as_large(camera, image)
        wrong[KNOWN] += reports_row(find_with_camera(image, crop, large))
        wrong[POSE_UNKNOWN] += reports_row(find_with_camera(image, crop, large, pose_known=False))
    source = "" if best_known is None else NETWORK
    return [
        Figure(
            f"{kind}, {len(pictures)} images",
            metric,
            times / len(pictures) * PERCENT,
            goal=GOAL_PERCENT,
            best_known=best_known,
            source=source,
            better=Better.LOWER,
        )
        for metric, times in wrong.items()
    ]
