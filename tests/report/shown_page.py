"""A page as a reader finds it: its text by section, its tables, its pictures, and whatever leads outside."""

from html.parser import HTMLParser
from pathlib import Path

from fieldnav.journal.directory import RunDirectory
from fieldnav.report.writing import write_report

VOID = frozenset({"meta", "link", "img", "br", "wbr"})
ADDRESSES = frozenset({"src", "href", "srcset", "data", "action", "poster", "xlink:href"})


class ShownPage(HTMLParser):
    """Parsed at once; `stray`: tags that were opened and not closed in order."""

    def __init__(self, path: Path) -> None:
        super().__init__(convert_charrefs=True)
        self.addresses: list[str] = []
        self.tags: list[str] = []
        self.texts: dict[str, list[str]] = {"": []}
        self.rows: dict[str, list[list[str]]] = {}
        self.stray: list[str] = []
        self._open: list[str] = []
        self._places: list[str] = [""]
        self.feed(path.read_text())
        self.close()

    def text(self, place: str) -> str:
        """What stands in the element of that id, with plain spaces."""
        return " ".join("".join(self.texts.get(place, ())).split())

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        self.tags.append(tag)
        self.addresses += [value or "" for name, value in attrs if name in ADDRESSES]
        if tag in VOID:
            return
        self._open.append(tag)
        place = found.get("id") or self._places[-1]
        self._places.append(place)
        if tag == "tr":
            self.rows.setdefault(place, []).append([])
        elif tag in ("td", "th"):
            self.rows[place][-1].append("")

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if self._open and self._open[-1] == tag:
            self._open.pop()
            self._places.pop()
        else:
            self.stray.append(tag)

    def handle_data(self, data: str) -> None:
        for place in set(self._places):
            self.texts.setdefault(place, []).append(data)
        place = self._places[-1]
        if "td" in self._open[-3:] or "th" in self._open[-3:]:
            self.rows[place][-1][-1] += data


def page_of(directory: RunDirectory) -> ShownPage:
    """The report of a run, written and parsed."""
    return ShownPage(write_report(directory))
