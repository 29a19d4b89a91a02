"""`fieldnav log diff`: the transitions in which two runs differ."""

from typing import Annotated, Any

import typer
from rich.table import Table

from fieldnav.cli.console import out, print_json, print_line, table
from fieldnav.cli.log.options import RUN_HELP, RUNS, JsonOption, RunsOption
from fieldnav.inquiry.difference import Change, Difference, Passed, Tolerance, differences
from fieldnav.inquiry.moment import clock
from fieldnav.journal.directory import RunDirectory, find_run
from fieldnav.journal.entry import Line
from fieldnav.journal.journal import read

DIFFERENT = 1
"""Exit status where the runs differ."""
WITHIN_M, WITHIN_S = 0.01, 0.1
"""What does not count as moved: less than a frame's worth of driving. Our choice."""


def diff(
    one: Annotated[str, typer.Argument(metavar="A", help=RUN_HELP)],
    other: Annotated[str, typer.Argument(metavar="B", help=RUN_HELP)],
    runs: RunsOption = RUNS,
    within_m: Annotated[float, typer.Option(min=0, help="Way, in m, that counts as not moved.")] = WITHIN_M,
    within_s: Annotated[float, typer.Option(min=0, help="Time, in s, that counts as not moved.")] = WITHIN_S,
    json: JsonOption = False,
) -> int:
    """Align two runs' transitions by lane and way: what moved, is missing, was added. Status 1 if any."""
    first, second = find_run(one, runs), find_run(other, runs)
    lines, others = read(first.journal), read(second.journal)
    found = differences(lines, others, Tolerance(within_m, within_s))
    if json:
        print_json([_as_json(each) for each in found])
    elif found:
        out().print(_differences_table(first, second, found))
        print(_counted(found))
    else:
        print_line(f"the same {_transitions(lines)} transitions in {first.path.name} and {second.path.name}")
    return DIFFERENT if found else 0


def _transitions(lines: list[Line]) -> int:
    return sum(line.source != line.target for line in lines)


def _counted(found: list[Difference]) -> str:
    counts = {change: sum(each.change is change for each in found) for change in Change}
    return ", ".join(f"{count} {change.value}" for change, count in counts.items() if count)


def _differences_table(first: RunDirectory, second: RunDirectory, found: list[Difference]) -> Table:
    columns = ("lane", "what", "event", "from", "to", "A", "B", "later by")
    rows = [
        (
            "" if each.lane is None else str(each.lane),
            each.change.value,
            *_named(each),
            _place(each.before),
            _place(each.after),
            _later(each),
        )
        for each in found
    ]
    title = f"A {first.path.name}, B {second.path.name}"
    return table(title, columns, rows, right=("lane", "A", "B", "later by"))


def _named(each: Difference) -> tuple[str, str, str]:
    passed = each.before or each.after
    assert passed is not None, "a difference is of at least one run"
    return passed.line.event, passed.line.source, passed.line.target


def _place(passed: Passed | None) -> str:
    if passed is None:
        return ""
    way = "" if passed.way_m is None else f"{passed.way_m:.2f} m, "
    return f"{way}{clock(passed.line.stamp_s)}"


def _later(each: Difference) -> str:
    if each.change is not Change.MOVED:
        return ""
    way = "" if each.moved_m is None else f"{each.moved_m:+.2f} m, "
    return f"{way}{each.moved_s or 0.0:+.1f} s"


def _as_json(each: Difference) -> dict[str, Any]:
    event, source, target = _named(each)
    return {
        "lane": each.lane,
        "change": each.change.value,
        "event": event,
        "source": source,
        "target": target,
        "a": _passed_json(each.before),
        "b": _passed_json(each.after),
        "moved_m": each.moved_m,
        "moved_s": each.moved_s,
    }


def _passed_json(passed: Passed | None) -> dict[str, Any] | None:
    if passed is None:
        return None
    return {
        "seq": passed.line.seq,
        "stamp_s": passed.line.stamp_s,
        "way_m": passed.way_m,
        "after_s": passed.after_s,
    }
