"""The program `fieldnav`, also `python -m fieldnav`."""

import os
import signal
from contextlib import suppress
from types import FrameType

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
"""Signals by which a person, a terminal or a service manager ends a program."""
INTERRUPTED = 130
"""Exit status, as shells have it for Ctrl-C (128 + SIGINT); here that of every signal."""
STANDARD_ERROR = 2


def main() -> None:
    for number in ENDING:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _end_at_once)
    from fieldnav.cli.app import main as command  # noqa: PLC0415 - takes a while, and the signals are set by then

    command()


def _end_at_once(number: int, frame: FrameType | None) -> None:
    """While modules are loaded nothing is open yet, and what an exception does to them nobody knows."""
    with suppress(OSError):
        os.write(STANDARD_ERROR, b"error: interrupted\n")
    os._exit(INTERRUPTED)


if __name__ == "__main__":
    main()
