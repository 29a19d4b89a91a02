"""The pictures of `bench navigation`: one a field, and one of all fields."""

from collections.abc import Sequence
from pathlib import Path

from fieldnav.evaluation.campaign_drawing import save
from fieldnav.evaluation.navigation_cases import Case
from fieldnav.evaluation.navigation_lane import Lane
from fieldnav.evaluation.navigation_overview import overview_picture
from fieldnav.evaluation.navigation_picture import lane_picture

OVERVIEW = "navigation.png"


def draw_navigation(folder: Path, cases: Sequence[Case], lanes: Sequence[Lane]) -> None:
    """Draw all of them into a folder that exists. Raises OutputError."""
    driven = {case: [lane for lane in lanes if lane.drive.case == case] for case in cases}
    driven = {case: its for case, its in driven.items() if its}
    for case, its in driven.items():
        save(lane_picture(case, its), folder / f"navigation-{_file_name(case)}.png")
    if driven:
        save(overview_picture(driven), folder / OVERVIEW)


def _file_name(case: Case) -> str:
    return case.name.replace(",", "").replace(" ", "-")
