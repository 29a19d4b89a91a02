"""Broken files read as fieldnav reads them: settings or a value, or one clear error; never else."""

import gc
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from time import process_time

from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.evaluation.benchmark import Failure
from fieldnav.evaluation.fuzz_originals import originals
from fieldnav.evaluation.fuzz_run_files import Original
from fieldnav.evaluation.fuzz_text import mutated
from fieldnav.journal.files import write_atomically

FILES = "files"
"""How a failure calls them, before a colon and the file's number."""
SLOWEST_S = 1.0
"""Longer may no file take, in seconds of this process: other programs' time is not the file's."""
LONGEST_LINE = 3000
"""Characters of an error; more is not a line that a person reads."""

TEXT_CODECS = "encodings."
"""Modules that Python itself loads for a kind of text."""

_ran: list[str] = []


def code_has_run(*_: object) -> None:
    """What the tags of some files would call."""
    _ran.append("code of a file's choosing has run")


@dataclass(frozen=True, slots=True)
class Batch:
    """Files from `first` to before `last`; those that go wrong are written into `kept`, if given."""

    first: int
    last: int
    seed: int
    kept: Path | None = None


@dataclass(frozen=True, slots=True)
class ReadBatch:
    """How a batch was read."""

    files: int
    accepted: int
    slowest_s: float
    failures: tuple[Failure, ...]


def read_batch(batch: Batch) -> ReadBatch:
    """Write, read and judge each file of a batch."""
    failures, accepted, slowest_s = [], 0, 0.0
    with TemporaryDirectory(prefix="fieldnav-") as folder:
        for index in range(batch.first, batch.last):
            original, content = fuzzed_file(index, batch.seed)
            path = original.place_in(Path(folder))
            path.write_bytes(content)
            wrong, was_accepted, took_s = judge(original, path)
            accepted, slowest_s = accepted + was_accepted, max(slowest_s, took_s)
            if wrong:
                failures.append(_failure(batch, index, original, content, wrong))
    return ReadBatch(batch.last - batch.first, accepted, slowest_s, tuple(failures))


def fuzzed_file(index: int, seed: int) -> tuple[Original, bytes]:
    """What file number `index` was made from, and its bytes."""
    random = Random(f"{seed} {FILES}:{index}")
    every = originals()
    original = random.choice(every)
    return original, mutated(original.text, [each.text for each in every], random)


def judge(original: Original, path: Path) -> tuple[str, bool, float]:
    """What is wrong with how a file is read, empty for nothing; whether it was accepted; seconds it took."""
    modules, started_s = set(sys.modules), process_time()
    _ran.clear()
    accepted, wrong = False, ""
    gc.disable()  # to look through all that a long test run has left takes a second, which is not the file's
    try:
        original.read(path)
        accepted = True
    except FieldnavError as error:
        wrong = unclear(error, original, path)
    except Exception as error:  # whatever it is, it is what is looked for
        wrong = f"{type(error).__name__}: {' '.join(str(error).split())}"
    finally:
        took_s = process_time() - started_s
        gc.enable()
    if took_s > SLOWEST_S:
        wrong = wrong or f"took {took_s:.1f} s"
    imported = [name for name in set(sys.modules) - modules if not name.startswith(TEXT_CODECS)]
    if imported:
        wrong = wrong or f"imported {', '.join(sorted(imported))}"
    return (_ran[0] if _ran else wrong), accepted, took_s


def unclear(error: FieldnavError, original: Original, path: Path) -> str:
    """What makes an error unclear, empty for one line of the right kind that names the file."""
    said = str(error)
    if original.settings and type(error) is not SettingsError:
        return f"{type(error).__name__} instead of SettingsError: {said}"
    if len(said.splitlines()) != 1:
        return f"an error of {len(said.splitlines())} lines: {said!r}"
    if len(said) > LONGEST_LINE:
        return f"an error of {len(said)} characters: {said[:100]}"
    if not said.isprintable():
        return f"an error with characters that no terminal should be sent: {said!r}"
    return "" if str(path) in said else f"an error that does not name the file: {said}"


def _failure(batch: Batch, index: int, original: Original, content: bytes, wrong: str) -> Failure:
    case, kept = f"{FILES}:{index}", ""
    if batch.kept is not None:
        copy = original.place_in(batch.kept)
        copy = copy.with_name(f"{index}-{copy.name}")
        write_atomically(copy, content)
        kept = f" (written to {copy})"
    again = f"fieldnav bench fuzz --seed {batch.seed} --again {case}"
    return Failure(case, f"{original.name}: {wrong[:500]}{kept}", again)


def batches(files: int, seed: int, kept: Path | None, size: int) -> Sequence[Batch]:
    """All files in batches."""
    return [Batch(first, min(first + size, files), seed, kept) for first in range(0, files, size)]
