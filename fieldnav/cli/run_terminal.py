"""A run's own terminal: one live line, and keys that speak to the mission."""

import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from rich.console import Console
from rich.live import Live
from rich.text import Text

from fieldnav.cli.console import watching
from fieldnav.cli.live_line import LiveLine
from fieldnav.faults import FAULTS, FaultKind
from fieldnav.mission.real import Watchers
from fieldnav.mission.tick import Tick
from fieldnav.operator.terminal import HELP, TerminalKeys
from fieldnav.settings.one_line import one_line
from states.names import Event, text

INTERRUPTING = (Event.PAUSE, Event.FAIL, Event.LATCH)
LATER = "or Ctrl-C, and later `fieldnav run --resume last`"
WHAT_NEXT = {
    Event.PAUSE: "go on with Enter, or `fieldnav ctl resume`",
    Event.FAIL: f"go on with Enter or `fieldnav ctl resume`; {LATER}",
    Event.LATCH: f"go on with `fieldnav ctl reset`; {LATER}",
}


class Announcer:
    """Says in plain lines why the robot stopped and what to do; the journal has the rest."""

    def __init__(self, console: Console) -> None:
        self._console = console

    def watch(self, tick: Tick) -> None:
        if tick.change is None or tick.change.event not in INTERRUPTING:
            return
        said = tick.reason or tick.change.event.value
        advice = next((FAULTS[kind].advice for kind in FaultKind if said.startswith(f"{kind.value}:")), "")
        self._console.print(Text(one_line(f"{tick.now_s:.1f} s  {text(tick.state)}: {said}"), "bold yellow"))
        for what in filter(None, (advice, WHAT_NEXT[tick.change.event])):
            self._console.print(Text(f"  {what}"))


@contextmanager
def terminal(lanes: int, quiet: bool) -> Iterator[Watchers]:
    """Who watches the run for the person at its terminal, and the keys; nobody where it is `quiet`."""
    console = watching()
    with ExitStack() as stack:
        keys = stack.enter_context(TerminalKeys(lambda said: console.print(Text(said))))
        requests = (keys,) if keys.here else ()
        if quiet:
            yield Watchers((), requests)
            return
        observers = [Announcer(console)]
        if not sys.stderr.isatty():
            yield Watchers(observers, requests)
            return
        if keys.here:
            console.print(Text(HELP, "dim"))
        live = stack.enter_context(Live(Text(""), console=console, auto_refresh=False, transient=True))
        yield Watchers([*observers, LiveLine(live, lanes, simulated=False)], requests)
