"""What happened, and why, in one line."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum

from fieldnav.inquiry.asked import Asked
from fieldnav.inquiry.cause import KILLED, Cause, cause_of
from fieldnav.inquiry.chances import chances
from fieldnav.inquiry.line_words import in_lane, states_of
from fieldnav.inquiry.moment import clock
from fieldnav.inquiry.stops import is_note, is_stop, top
from fieldnav.inquiry.words import judgements
from fieldnav.journal.entry import Judged, Line
from states.names import Top


class Kind(Enum):
    """What there is to explain."""

    STOPPED = "stopped"
    PAUSED = "paused"
    BROKE_OFF = "broke off"
    CHANGED = "changed"
    NOTED = "noted"
    NOTHING = "nothing"


@dataclass(frozen=True, slots=True)
class Headline:
    """text: the line; cause: what it comes down to; evidence: what had been judged."""

    kind: Kind
    text: str
    cause: Cause
    evidence: tuple[Judged, ...] = ()


def headline(asked: Asked, judged: Sequence[Judged] = ()) -> Headline:
    """judged: what the state judged last before the moment, where there is a recording that knows."""
    line = asked.line
    evidence = tuple(line.evidence) if asked.happened and line.evidence else tuple(judged)
    if asked.broken_off:
        return _broke_off(asked, evidence)
    if not asked.happened:
        return _nothing(asked, evidence)
    cause = cause_of(line, asked.before)
    kind = _kind(line)
    what = kind.value if kind in (Kind.STOPPED, Kind.PAUSED) else line.event
    change = f"{'in ' if is_note(line) else ''}{states_of(line)}"
    return Headline(
        kind, f"{what} at {clock(line.stamp_s)}{in_lane(line.lane)}, {change}: {cause.said}", cause, evidence
    )


def _kind(line: Line) -> Kind:
    if is_stop(line):
        return Kind.PAUSED if top(line.target) == Top.PAUSED.value else Kind.STOPPED
    return Kind.NOTED if is_note(line) else Kind.CHANGED


def _broke_off(asked: Asked, evidence: tuple[Judged, ...]) -> Headline:
    line = asked.line
    cause = Cause(str(KILLED), KILLED.fault, (line,))
    text = f"broke off at {clock(asked.at_s)}{in_lane(line.lane)}, in {line.target}: {cause.said}"
    return Headline(Kind.BROKE_OFF, text, cause, evidence)


def _nothing(asked: Asked, evidence: tuple[Judged, ...]) -> Headline:
    """Why the state was not left: the event that was nearest, or, at rest, what it stands for."""
    line = asked.line
    since = f"{line.target} since {clock(line.stamp_s)}"
    nearest = next((chance for chance in chances(evidence) if not chance.holds), None)
    if nearest is not None:
        said = f"nearest was {nearest.event}, but {judgements(nearest.deciding)}"
    elif is_stop(line):
        said = cause_of(line, asked.before).said
    else:
        said = "what was judged then is not written down" if not evidence else "no condition of an event"
    text = f"nothing changed at {clock(asked.at_s)}{in_lane(line.lane)}, {since}: {said}"
    return Headline(Kind.NOTHING, text, replace(cause_of(line, asked.before), said=said), evidence)
