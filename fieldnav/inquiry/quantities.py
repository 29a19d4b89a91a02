"""Quantities that are picked out of the evidence, by the names that the states give them."""

from collections.abc import Iterable

from fieldnav.journal.entry import Judged

OFFSET = "offset from the lane"
HEADING = "heading against the lane"
LANE_ENDED = "probability that the lane has ended"
NEXT_LANE = "probability of its place"
LENGTH = "length of this lane"


def value_of(evidence: Iterable[Judged], name: str) -> float | None:
    """The value of the quantity of that name; None where it was not judged or was no number."""
    return next((judged.value for judged in evidence if judged.name == name), None)
