"""How far long work is: bars on the terminal; nothing where nobody watches."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from fieldnav.evaluation.benchmark import Progress


@contextmanager
def watched() -> Iterator[Progress]:
    """What to tell how far each part is."""
    if not sys.stderr.isatty():
        yield lambda part, done, steps: None
        return
    from fieldnav.cli.bench_progress import PartBars  # noqa: PLC0415 - only for a person who watches

    with PartBars() as bars:
        yield bars.tell
