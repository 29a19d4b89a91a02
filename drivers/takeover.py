"""Somebody else commands the wheels: a remote that takes over, or an intruder."""

from drivers.thorvald_protocol import Kind
from drivers.wire_layout import Telegram

COMMANDS = frozenset({Kind.DRIVE, Kind.STEER, Kind.MODE, Kind.SET_UP, Kind.NMT})
"""Telegrams that only a host sends; this host's own are left out where an adapter gives them back."""
QUIET_S = 1.0
"""So long nothing must come before the wheels are this host's again; twice the modules' slowest watchdog."""


class Takeover:
    """Notes commands of others; the host yields while they last, for two hosts make a robot jerk."""

    def __init__(self) -> None:
        self._heard_s = float("-inf")
        self._told = False

    def is_command(self, telegram: Telegram) -> bool:
        return telegram.kind in COMMANDS

    def note(self, telegram: Telegram, called: str, now_s: float) -> str:
        """Take in a command; what to say of it, empty where this take-over has been told already."""
        if now_s - self._heard_s > QUIET_S:
            self._told = False
        self._heard_s = now_s
        if self._told:
            return ""
        self._told = True
        said = ", ".join(f"{name} {value:g}" for name, value in telegram.values.items())
        return f"{called} is commanded by another sender: {telegram.kind.value} {said}".rstrip()

    def lasts(self, now_s: float) -> bool:
        return now_s - self._heard_s <= QUIET_S
