"""Ctrl-C, a closed terminal, a service manager: once, a run stops in good order; twice, it ends at once."""

import signal
from types import FrameType, TracebackType
from typing import Any, Self

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""The last comes when the terminal is closed, or its connection lost."""
AT_ONCE = signal.SIGQUIT
"""Ctrl-\\, which asks for no good order."""


class Interruption:
    """Notes the first signal, so that no round of the loop is torn; the second raises KeyboardInterrupt.

    SIGQUIT raises it without having been noted. Whatever comes after that is passed over: by then the wheels
    are commanded to stand, and the files are closed.
    """

    def __init__(self) -> None:
        self.asked = False
        self._ending = False
        self._before: dict[signal.Signals, Any] = {}

    def __enter__(self) -> Self:
        for number in (*SIGNALS, AT_ONCE):
            if signal.getsignal(number) is not signal.SIG_IGN:
                self._before[number] = signal.signal(number, self._note)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _note(self, number: int, frame: FrameType | None) -> None:
        if self._ending:
            return
        self._ending = self.asked or number == AT_ONCE
        self.asked = True
        if self._ending:
            raise KeyboardInterrupt
