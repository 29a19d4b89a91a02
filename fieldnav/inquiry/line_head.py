"""How each line of a journal begins, see entry.line_of: enough to choose lines by without parsing them."""

import re

HEAD = re.compile(
    rb'\{"seq": (?P<seq>\d{1,16}), "stamp_s": (?P<stamp_s>-?\d{1,16}(?:\.\d{1,16})?(?:e[+-]?\d{1,2})?), '
    rb'"utc": "[^"\\]*", '
    rb'"event": "(?P<event>[^"\\]*)", "source": "(?P<source>[^"\\]*)", "target": "(?P<target>[^"\\]*)", '
    rb'"lane": (?P<lane>\d{1,4}|null), '
)
"""Does not match a line that was written otherwise, or holds escapes: that one has to be parsed."""

Names = tuple[bytes, bytes, bytes]
"""Event, source and target."""


def order_of(text: bytes) -> tuple[int, float] | None:
    """A line's number and its stamp in s, which rise from line to line; None where only parsing tells."""
    head = HEAD.match(text)
    return None if head is None else (int(head["seq"]), float(head["stamp_s"]))


def names_of(text: bytes) -> tuple[Names, int | None] | None:
    """What happened and in which lane; None where only parsing tells."""
    head = HEAD.match(text)
    if head is None:
        return None
    event, source, target, lane = head.group("event", "source", "target", "lane")
    return (event, source, target), None if lane == b"null" else int(lane)
