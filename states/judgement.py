"""Which event follows from what was judged: states decide by the very evidence that they give."""

from collections.abc import Iterable

from fieldnav.messages import Evidence
from fieldnav.perception.perceive import View
from fieldnav.perception.second_witness import BORNE_OUT
from states.names import Event


def first_of(evidence: Iterable[Evidence], *events: Event) -> Event | None:
    """The first of some events that comes about; None where none does."""
    judged = tuple(evidence)
    return next((event for event in events if comes_about(judged, event)), None)


def comes_about(evidence: Iterable[Evidence], event: Event) -> bool:
    """Whether one of the event's conditions that are enough alone holds, or all of the others, if any."""
    conditions = [judged for judged in evidence if judged.fires is event]
    together = [holds(judged) for judged in conditions if not judged.alone]
    return any(holds(judged) for judged in conditions if judged.alone) or (bool(together) and all(together))


def holds(judged: Evidence) -> bool:
    """Whether a quantity lies on that side of its threshold which its event wants."""
    return judged.threshold is not None and judged.bound.holds(judged.value, judged.threshold)


def second_opinion(found: View) -> tuple[Evidence, ...]:
    """What the network says of the rows that a fresh look shows; nothing where there are none."""
    if found.borne_out is None:
        return ()
    return (Evidence("share of a row that the network bears out", found.borne_out, BORNE_OUT),)
