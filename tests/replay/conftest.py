"""A short run on small pictures, recorded as every run is."""

from pathlib import Path

import pytest

from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import Side
from fieldnav.mission.simulated import Run, simulate
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> RunDirectory:
    """One lane and its end, nothing else changed: 4 m of sugar beet."""
    field = revised(load_field("demo"), {"lanes": 2, "length_m": 4})
    robot = smaller(smaller(load_robot("bonnbot")))
    parent: Path = tmp_path_factory.mktemp("runs")
    run = Run(field, load_crop(field.crop), robot, 2, Side.RIGHT, parent, sketch=True, record=True)
    return simulate(run).directory
