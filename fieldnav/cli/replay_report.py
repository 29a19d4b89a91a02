"""What a replay found, for a person."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from math import degrees
from typing import TYPE_CHECKING

from rich.console import Group, RenderableType
from rich.markup import escape
from rich.text import Text

from fieldnav.cli.console import table, watching
from fieldnav.inquiry.moment import clock
from fieldnav.settings.one_line import one_line

if TYPE_CHECKING:
    from fieldnav.replay.difference import Commands, Difference, Replayed
    from fieldnav.replay.replay import Tell

COLUMNS = ("time", "lane", "event", "from", "to", "difference")


def report(done: "Replayed") -> RenderableType:
    """The differences in a table, below them the commands; or that there are none."""
    head = (
        f"{one_line(done.run)}: {done.transitions} transitions and {done.rounds} rounds of "
        f"{clock(done.seconds)} replayed"
    )
    if done.same:
        return Text.assemble(head, ": ", ("no difference, bit for bit", "bold green"))
    parts: list[RenderableType] = [Text(head)]
    if done.differences:
        rows = [_row(each) for each in done.differences]
        parts.append(table("", COLUMNS, rows, right=("time", "lane")))
    else:
        parts.append(Text("every transition the same"))
    parts += [Text(_commands(done)), *(Text(one_line(said), style="yellow") for said in done.incomplete)]
    return Group(*parts)


def _row(each: "Difference") -> tuple[str | Text, ...]:
    line = each.line
    lane = "" if line.lane is None else str(line.lane)
    return (
        clock(line.stamp_s),
        lane,
        line.event,
        line.source,
        line.target,
        Text(one_line(said(each)), style="bold"),
    )


def said(each: "Difference") -> str:
    """A difference in a few words."""
    if each.later_s is None or not each.later_s:
        return f"{each.kind.value}: {each.said}" if each.said else each.kind.value
    word = "later" if each.later_s > 0 else "earlier"
    metres = "" if each.later_m is None else f", {abs(each.later_m):.2f} m"
    return f"{abs(each.later_s):.2f} s{metres} {word}"


def _commands(done: "Replayed") -> str:
    commands: Commands = done.commands
    if not commands.rounds:
        return "every command the same, bit for bit"
    return (
        f"commands differ in {commands.rounds} of {done.rounds} rounds, "
        f"first at {clock(commands.first_s or 0)}, "
        f"by at most {max(commands.vx_mps, commands.vy_mps):.3f} m/s and "
        f"{degrees(commands.yaw_rate_rps):.2f} deg/s"
    )


@contextmanager
def watched(title: str) -> Iterator["Tell | None"]:
    """A bar on the terminal; nothing where nobody watches."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.progress import Progress  # noqa: PLC0415 - only for a person who watches

    with Progress(console=watching(), transient=True) as bar:
        task = bar.add_task(escape(one_line(title)), total=None)
        yield lambda now_s, end_s: bar.update(task, completed=now_s, total=end_s)
