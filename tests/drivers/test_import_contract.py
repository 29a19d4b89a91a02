"""The import contract between the drivers' real part and the simulated modules names every file of both."""

import tomllib
from pathlib import Path

import pytest

import drivers

FOLDER = Path(drivers.__file__).parent
PYPROJECT = FOLDER.parent / "pyproject.toml"
CONTRACT = "The real part of the drivers never sees the simulated modules beside it"


@pytest.fixture(scope="module")
def contract():
    if not PYPROJECT.exists():
        pytest.skip("installed without its pyproject.toml")
    linter = tomllib.loads(PYPROJECT.read_text(encoding="utf-8"))["tool"]["importlinter"]
    return next(one for one in linter["contracts"] if one["name"] == CONTRACT)


def modules_of(*, simulated):
    names = {path.stem for path in FOLDER.glob("*.py")} - {"__init__"}
    return {f"drivers.{name}" for name in names if name.startswith("simulated_") is simulated}


def test_no_real_driver_is_left_out_of_the_contract(contract):
    assert set(contract["source_modules"]) == modules_of(simulated=False)


def test_no_simulated_module_is_left_out_of_the_contract(contract):
    assert set(contract["forbidden_modules"]) == modules_of(simulated=True)
