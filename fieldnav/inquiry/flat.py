"""A journal as a table of plain figures: one row a line, a column for every quantity that was ever judged."""

from collections.abc import Iterable, Iterator

from fieldnav.journal.entry import DIGITS, Judged, Line

Cell = str | int | float | None
PLAIN = (
    "seq",
    "stamp_s",
    "utc",
    "event",
    "source",
    "target",
    "lane",
    "rows",
    "reason",
    "forward_m",
    "sideways_m",
)
COMMAND, FRAME = ("vx_mps", "vy_mps", "yaw_rate_rps"), ("camera", "sequence", "stamp_s")


def columns(lines: Iterable[Line]) -> list[str]:
    """The names of the columns, for the rows of these lines."""
    names: dict[str, None] = {}
    for line in lines:
        for judged in line.evidence:
            names |= dict.fromkeys(_named(judged))
    return [*PLAIN, *COMMAND, *(f"frame_{name}" for name in FRAME), *names]


def rows(lines: Iterable[Line]) -> Iterator[dict[str, Cell]]:
    """Each line by the columns' names; where a quantity was not judged its columns lack."""
    for line in lines:
        plain: dict[str, Cell] = {name: getattr(line, name) for name in PLAIN if name != "utc"}
        plain["utc"] = line.utc.isoformat(timespec="milliseconds").replace("+00:00", "Z")
        plain |= {name: (line.command or {}).get(name) for name in COMMAND}
        plain |= {f"frame_{name}": (line.frame or {}).get(name) for name in FRAME}
        for judged in line.evidence:
            plain |= dict(zip(_named(judged), (judged.value, judged.threshold, _margin(judged)), strict=True))
        yield plain


def _margin(judged: Judged) -> float | None:
    return None if judged.margin is None else round(judged.margin, DIGITS) + 0.0


def _named(judged: Judged) -> tuple[str, str, str]:
    """The columns of a quantity: its value with the unit, its threshold, its margin."""
    unit = f" [{judged.unit}]" if judged.unit else ""
    return f"{judged.name}{unit}", f"{judged.name}: threshold", f"{judged.name}: margin"
