"""How a run of switches that failed is driven again: the command, and the field file that it needs."""

from pathlib import Path

import yaml

from fieldnav.errors import OutputError
from fieldnav.evaluation.switching_runs import SwitchRun


def again(wanted: SwitchRun, folder: Path | None) -> str:
    """The command; given a folder, a field file is written there and looked at with `simulate`.

    Raises OutputError.
    """
    run = wanted.run
    if folder is None:
        return f"fieldnav bench switching --seed {run.field.seed} --switches {run.lanes - 1}"
    path = folder / f"{run.field.name}-{run.crop.name}-{run.side.value}-{run.field.seed}.yaml"
    document = yaml.safe_dump(run.field.model_dump(mode="json"), sort_keys=False)
    try:
        path.write_text(document, encoding="utf-8")
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror}") from error
    return f"fieldnav simulate {path} --side {run.side.value}"
