"""The state machine's diagram as Mermaid text, from the table that the machine runs on."""

from collections.abc import Iterable, Iterator

from states.drawing.picture import svg
from states.names import Event, Path
from states.table import IDLE, LEAVES, TRANSITIONS

__all__ = ["INTERRUPTED", "edges", "mermaid", "svg"]

INTERRUPTED = "where it was interrupted"
"""How a transition without a target is drawn: a state of its own to which resuming leads."""
INDENT = "    "


def mermaid() -> str:
    """The whole table as a Mermaid state diagram; a transition of a composite is drawn from the composite."""
    interrupted = f'{INDENT}state "{INTERRUPTED}" as {_identity(None)}'
    arrows = [
        f"{INDENT}{_identity(source)} --> {_identity(target)}: {' / '.join(event.value for event in events)}"
        for (source, target), events in edges().items()
    ]
    start = f"{INDENT}[*] --> {_identity(IDLE)}"
    return "\n".join(["stateDiagram-v2", *_declared(LEAVES, 1), interrupted, start, *arrows])


def edges() -> dict[tuple[Path, Path | None], list[Event]]:
    """The arrows of the diagram, those between the same two states as one with all its events."""
    result: dict[tuple[Path, Path | None], list[Event]] = {}
    for row in TRANSITIONS:
        result.setdefault((row.source, row.target), []).append(row.event)
    return result


def _declared(leaves: Iterable[Path], depth: int) -> Iterator[str]:
    """Every state, composites around their children; leaves of one composite lie together in the table."""
    indent, inside = INDENT * depth, [*leaves]
    for head in dict.fromkeys(leaf[:depth] for leaf in inside):
        below = [leaf for leaf in inside if leaf[:depth] == head and len(leaf) > depth]
        name = f'{indent}state "{head[-1].value}" as {_identity(head)}'
        if not below:
            yield name
            continue
        yield f"{name} {{"
        yield from _declared(below, depth + 1)
        yield f"{indent}}}"


def _identity(path: Path | None) -> str:
    return "Interrupted" if path is None else "".join(str(member.value) for member in path)
