"""`python -m fieldnav.training`: draw pictures, train the network on them, write it as ONNX."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from fieldnav.errors import FieldnavError, OutputError, SettingsError
from fieldnav.training.pool import CHUNK_PICTURES, SEEDS, Pool, drawing

WRONG_INPUT = 2
"""Exit status, as argparse has it."""
INTERRUPTED = 130
"""Exit status, as shells have it for Ctrl-C (128 + SIGINT)."""
MIN_CHUNKS = 2  # one to train on and the one held out
MAX_SEED = 2**32


@dataclass(frozen=True, slots=True)
class TrainingConfig:
    """What to draw, how long to train and where to write."""

    out: Path
    pool: Pool
    minutes: float
    processes: int
    threads: int


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        raise SettingsError(message)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program; returns its exit status."""
    try:
        run(parse(arguments))
    except FieldnavError as error:
        print(f"error: {error}", file=sys.stderr)
        return WRONG_INPUT
    except KeyboardInterrupt:
        print("error: interrupted", file=sys.stderr)
        return INTERRUPTED
    return 0


def parse(arguments: Sequence[str] | None) -> TrainingConfig:
    """The configuration of a command line; raises SettingsError."""
    parser = _Parser(prog="python -m fieldnav.training", description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="the ONNX file to write")
    parser.add_argument("--pictures", type=int, default=40_000, help="to draw; the last 1,000 are held out")
    parser.add_argument("--minutes", type=float, default=90.0, help="of training")
    parser.add_argument("--seed", type=int, default=0, help="of the pictures and of the training")
    parser.add_argument("--processes", type=int, default=2, help="that draw pictures")
    parser.add_argument("--threads", type=int, default=2, help="of the training; 1 while the cores are busy")
    parser.add_argument("--pool", type=Path, help="folder of the pictures; by default beside the ONNX file")
    given = parser.parse_args(arguments)
    _check(given)
    folder = given.pool or given.out.with_suffix(".pool")
    pool = Pool(folder, given.seed, given.pictures // CHUNK_PICTURES)
    return TrainingConfig(given.out, pool, given.minutes, given.processes, given.threads)


def run(config: TrainingConfig) -> None:
    """Draw, train and export."""
    try:
        from fieldnav.training.export import export  # noqa: PLC0415 - wrong input is told without PyTorch
        from fieldnav.training.train import train  # noqa: PLC0415 - the same
    except ImportError as error:
        raise SettingsError(f"{error}: install it with pip install 'fieldnav[training]'") from error
    with drawing(config.pool, config.processes) as drawers:
        trained = train(config.pool, drawers, config.minutes, config.threads, _say)
    _say(f"held-out pictures: {trained.held_out}")
    export(trained, config.out, config.pool.seed)
    _say(f"wrote {config.out} after {trained.steps} steps")


def _check(given: argparse.Namespace) -> None:
    if given.pictures % CHUNK_PICTURES or not MIN_CHUNKS * CHUNK_PICTURES <= given.pictures < SEEDS:
        raise SettingsError(f"--pictures {given.pictures}: must be 2,000 or more in steps of 1,000")
    if not 0 < given.minutes < float("inf"):
        raise SettingsError(f"--minutes {given.minutes}: must be more than 0")
    if not 0 <= given.seed < MAX_SEED:
        raise SettingsError(f"--seed {given.seed}: must be from 0 to {MAX_SEED - 1}")
    for option in ("processes", "threads"):
        if getattr(given, option) < 1:
            raise SettingsError(f"--{option} {getattr(given, option)}: must be 1 or more")
    if given.out.suffix != ".onnx":
        raise SettingsError(f"--out {given.out}: must end in .onnx")
    if not given.out.parent.is_dir() or given.out.is_dir():
        raise OutputError(f"--out {given.out}: there is no folder for it, or a folder has its name")


def _say(line: str) -> None:
    print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
