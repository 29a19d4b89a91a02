"""A run's journal as the figures that are painted into the state machine's diagram."""

from fieldnav.inquiry.outcome import Overview, overview
from fieldnav.inquiry.spent import Account, account
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.journal import read
from states.drawing.paint import Made, Paint, Visit
from states.names import Event
from states.table import LEAF_NAMED

EVENT_OF = {event.value: event for event in Event}


def paint_of(directory: RunDirectory) -> Paint:
    """What a run's journal tells. Raises FieldnavError for one that cannot be read."""
    return paint(account(read(directory.journal)), overview(directory))


def paint(told: Account, ended: Overview) -> Paint:
    """An account in the table's own states and events; those of another version are counted as unknown."""
    visits = {
        LEAF_NAMED[state]: Visit(spent.seconds, spent.entries)
        for state, spent in told.states.items()
        if state in LEAF_NAMED
    }
    made: dict[Made, int] = {}
    unknown = 0
    for (source, event, target), count in told.made.items():
        if source in LEAF_NAMED and event in EVENT_OF and target in LEAF_NAMED:
            made[LEAF_NAMED[source], EVENT_OF[event], LEAF_NAMED[target]] = count
        else:
            unknown += count
    return Paint(
        ended.run, ended.outcome.value, ended.reason, visits, made, LEAF_NAMED.get(told.last), unknown
    )
