"""Keys on the running mission's own terminal: p pauses, Enter resumes or says yes, q stops."""

import os
import select
import signal
import termios
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import TracebackType
from typing import Self

from fieldnav.operator.request import Answer, Command, Request

STANDARD_INPUT = 0
HELP = "p pauses, Enter resumes or says yes, q stops"
WHO = "the mission's terminal"

KEYS = {
    ord("q"): Command.STOP,
    ord("p"): Command.PAUSE,
    ord("\r"): Command.RESUME,
    ord("\n"): Command.RESUME,
}
CAREFUL_FIRST = (Command.STOP, Command.PAUSE, Command.RESUME)
"""Of keys that come in one round, a paste or a palm on the keyboard, the most careful one counts."""
ESCAPE = 0x1B
"""Begins what arrow and function keys send; letters of theirs are no keys of ours."""
MOST_BYTES = 1024

INPUT_MODES, LOCAL_MODES, CHARACTERS = 0, 3, 6
"""Where they stand in the list that termios gives."""
OFF_LOCAL = termios.ICANON | termios.ECHO
"""Keys come at once and are not shown; Ctrl-C still interrupts."""
OFF_INPUT = termios.IXON
"""Else Ctrl-S would stop the terminal, and whatever is printed would hold up the loop."""


class TerminalKeys:
    """Makes requests of keys; does nothing without a terminal or in the background. Use it as a context."""

    def __init__(self, show: Callable[[str], None], descriptor: int = STANDARD_INPUT) -> None:
        self._show, self._descriptor = show, descriptor
        self._found: list[int | list[bytes | int]] | None = None
        self._here = os.isatty(descriptor)
        self._pressed = select.poll()
        if self._here:
            self._pressed.register(descriptor, select.POLLIN)

    @property
    def here(self) -> bool:
        """Whether there is a terminal to press keys on."""
        return self._here

    def poll(self, now_s: float) -> tuple[Request, ...]:
        """The request of the keys pressed since the last look; at most one. Never waits, never raises."""
        if not self._here or not self._in_front() or self._take_over() or not self._pressed.poll(0):
            return ()
        pressed = self._read()
        keys = pressed.lower() if ESCAPE not in pressed else b""
        commands = {KEYS[key] for key in keys if key in KEYS}
        chosen = [command for command in CAREFUL_FIRST if command in commands][:1]
        return tuple(Request(command, WHO, self._tell) for command in chosen)

    def close(self) -> None:
        """Give the terminal back as it was found; a shell that has taken it over has done so itself."""
        if self._found is not None and self._in_front():
            with _unstopped(), suppress(termios.error, OSError):
                termios.tcsetattr(self._descriptor, termios.TCSANOW, self._found)
        self._here, self._found = False, None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _in_front(self) -> bool:
        """Whether the terminal is ours to use and not that of a shell which runs us in the background."""
        try:
            return os.tcgetpgrp(self._descriptor) == os.getpgrp()
        except OSError:  # gone, or the terminal of another session that we were given
            return False

    def _take_over(self) -> bool:
        """Set the terminal to single keys where it is not, at first or after a shell has had it.

        What was typed before that was not meant for us: it is thrown away, and True returned.
        """
        with _unstopped(), suppress(termios.error, OSError):
            modes = termios.tcgetattr(self._descriptor)
            if not modes[LOCAL_MODES] & termios.ICANON:
                return False
            self._found = termios.tcgetattr(self._descriptor)
            modes[CHARACTERS][termios.VMIN], modes[CHARACTERS][termios.VTIME] = 1, 0  # a read never waits
            modes[LOCAL_MODES] &= ~OFF_LOCAL
            modes[INPUT_MODES] &= ~OFF_INPUT
            termios.tcsetattr(self._descriptor, termios.TCSANOW, modes)
            termios.tcflush(self._descriptor, termios.TCIFLUSH)
        return True

    def _read(self) -> bytes:
        """What was typed; nothing where the terminal has been lost, or taken by a shell at this moment."""
        with _unstopped(), suppress(OSError):
            return os.read(self._descriptor, MOST_BYTES)
        return b""

    def _tell(self, answer: Answer) -> None:
        with suppress(OSError):
            self._show(answer.said)


@contextmanager
def _unstopped() -> Iterator[None]:
    """Put in the background at this very moment, the process gets an error and is not stopped by a signal."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTTIN, signal.SIGTTOU})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
