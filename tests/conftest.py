"""For all tests: a machine that others use is no fault of the code's, nor is how the tests were begun."""

import json
import signal
from pathlib import Path

import pytest
from hypothesis import settings

from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.settings.loading import load_robot

settings.register_profile("shared machine", deadline=None)
settings.load_profile("shared machine")

# What a shell starts in the background ignores Ctrl-C, and so would every command that a test interrupts.
signal.signal(signal.SIGINT, signal.default_int_handler)
for ignored in (signal.SIGQUIT, signal.SIGHUP):
    signal.signal(ignored, signal.SIG_DFL)


@pytest.fixture(scope="session")
def quick_robot_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The robot with cameras of a quarter of the width and the height: quick to draw and to look at."""
    path = tmp_path_factory.mktemp("robot") / "quick.yaml"
    path.write_text(json.dumps(smaller(load_robot("bonnbot"), 4).model_dump(mode="json")))
    return path
