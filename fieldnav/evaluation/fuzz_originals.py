"""The good files that the fuzz begins from, each with how fieldnav reads it."""

from collections.abc import Callable
from functools import cache
from importlib.resources import files
from math import isfinite
from pathlib import Path

import yaml

from fieldnav.errors import SettingsError
from fieldnav.evaluation.fuzz_run_files import CROP, ROBOT, Original, files_of_a_run
from fieldnav.messages import CameraName
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.fit import check_fit, check_size
from fieldnav.settings.kinds import Kind, names_of
from fieldnav.settings.loading import load, load_crop, load_robot
from fieldnav.settings.robot import Robot

FULL_WEIGHT, RUN_WEIGHT = 3, 2
"""How much more often than a shipped file each of the others is taken; our choice."""


@cache
def originals() -> tuple[Original, ...]:
    """Every shipped file as shipped, one of each kind with all its defaults, and the files of a run."""
    shipped = [
        Original(f"{kind.singular}-{name}.yaml", _shipped(kind, name), _reader(kind))
        for kind in Kind
        for name in names_of(kind)
    ]
    full = [Original(f"{kind.singular}.yaml", _full(kind), _reader(kind)) for kind in Kind] * FULL_WEIGHT
    return (*shipped, *full, *files_of_a_run() * RUN_WEIGHT)


def _shipped(kind: Kind, name: str) -> str:
    return (files("config") / kind.value / f"{name}.yaml").read_text(encoding="utf-8")


def _full(kind: Kind) -> str:
    """The first shipped file of a kind with every default written out."""
    return yaml.safe_dump(load(kind, names_of(kind)[0]).model_dump(mode="json"), sort_keys=False)


def _reader(kind: Kind) -> Callable[[Path], None]:
    def read_settings(path: Path) -> None:
        settings = load(kind, path)
        _check_numbers(settings.model_dump(), str(path))
        try:
            _use(settings)
        except SettingsError as error:  # of two files that do not fit each other; it names what is in them
            raise SettingsError(f"{path}: {error}") from error

    return read_settings


def _use(settings: CropProfile | Robot | FieldSettings) -> None:
    """What is done with settings before anything moves."""
    match settings:
        case CropProfile():
            check_fit(settings, load_robot(ROBOT))
        case Robot():
            check_fit(load_crop(CROP), settings)
            for name in CameraName:
                settings.cameras.get(name).pinhole()
        case FieldSettings():
            check_size(settings, load_crop(settings.crop))


def _check_numbers(value: object, label: str) -> None:
    """Accepted settings hold finite numbers alone."""
    match value:
        case dict():
            for each in value.values():
                _check_numbers(each, label)
        case list() | tuple():
            for each in value:
                _check_numbers(each, label)
        case float() if not isfinite(value):
            raise ValueError(f"{label}: accepted with the number {value}")
