"""A run's transitions under its lanes and their phases."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from rich.text import Text
from rich.tree import Tree

from fieldnav.inquiry.cause import reason_of
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.stops import is_note, is_stop
from fieldnav.journal.entry import Line
from fieldnav.settings.one_line import one_line

PHASE_PARTS = 2
"""Of a state's name, the direction and the phase: Forward.Follow."""


def lanes_tree(lines: Sequence[Line]) -> Tree:
    """Each line beneath the phase in which it happened, each phase beneath its lane."""
    tree = Tree("", hide_root=True, guide_style="dim")
    for lane, within in groupby(lines, key=lambda line: line.lane):
        branch = tree.add(Text("before the first lane" if lane is None else f"lane {lane}", style="bold"))
        for phase, in_phase in groupby(within, key=_phase):
            shown = list(in_phase)
            leaf = branch.add(
                Text.assemble((one_line(phase), "cyan"), (f"  {clock(shown[0].stamp_s)}", "dim"))
            )
            for line in shown:
                leaf.add(Text.assemble(*((one_line(told), style) for told, style in _told(line, phase))))
    return tree


def _phase(line: Line) -> str:
    return ".".join(line.source.split(".")[:PHASE_PARTS])


def _told(line: Line, phase: str) -> Iterator[tuple[str, str]]:
    """When, on which event, where to, and why; of where it goes only what differs from the phase."""
    yield f"{clock(line.stamp_s)} ", "dim"
    yield line.event, "bold red" if is_stop(line) else "bold"
    if not is_note(line):
        yield f" -> {line.target.removeprefix(f'{phase}.')}", ""
    if because := reason_of(line):
        yield f"  {because}", "red" if is_stop(line) else "dim"
