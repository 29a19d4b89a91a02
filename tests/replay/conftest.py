"""Short runs on small pictures, recorded as every run is."""

from pathlib import Path

import pytest

from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.journal.directory import RunDirectory
from fieldnav.messages import Side
from fieldnav.mission.simulated import Run, simulate
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised


def drive(parent: Path, lanes: int) -> RunDirectory:
    """Lanes of 4 m of sugar beet."""
    field = revised(load_field("demo"), {"lanes": lanes, "length_m": 4})
    robot = smaller(load_robot("bonnbot"), 4)
    run = Run(field, load_crop(field.crop), robot, lanes, Side.RIGHT, parent, sketch=True, record=True)
    return simulate(run).directory


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> RunDirectory:
    """One lane and its end."""
    return drive(tmp_path_factory.mktemp("runs"), lanes=1)


@pytest.fixture(scope="session")
def two_lanes(tmp_path_factory: pytest.TempPathFactory) -> RunDirectory:
    """Two lanes with the sidestep between them; four times as dear to replay as one."""
    return drive(tmp_path_factory.mktemp("runs"), lanes=2)
