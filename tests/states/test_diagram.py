"""The diagram shows the table, all of it and nothing else."""

import re
from xml.etree import ElementTree

import pytest

from states.diagram import INTERRUPTED, mermaid, svg
from states.drawing.layout import Drawn, lay_out
from states.names import Path, text
from states.table import IDLE, LEAVES, TRANSITIONS

SVG = "{http://www.w3.org/2000/svg}"


def identity(path: Path | None) -> str:
    return "Interrupted" if path is None else text(path).replace(".", "")


def test_the_mermaid_text_has_an_arrow_with_its_event_for_each_transition() -> None:
    arrows = re.findall(r"^ +(\S+) --> (\S+): (.+)$", mermaid(), flags=re.MULTILINE)
    drawn = {(source, target, event) for source, target, events in arrows for event in events.split(" / ")}

    assert drawn == {(identity(row.source), identity(row.target), row.event.value) for row in TRANSITIONS}


def test_the_mermaid_text_declares_every_state_once_within_its_composites() -> None:
    lines = mermaid().splitlines()
    open_states: list[str] = []
    declared: list[str] = []
    for line in lines:
        if match := re.match(r' +state "(.+)" as (\S+)( {)?$', line):
            name, key, opens = match.groups()
            assert key == "".join(open_states) + name or name == INTERRUPTED
            declared.append(key)
            open_states += [name] if opens else []
        elif line.strip() == "}":
            open_states.pop()

    assert not open_states
    assert len(declared) == len(set(declared))
    assert {identity(leaf) for leaf in LEAVES} <= set(declared)
    assert lines[0] == "stateDiagram-v2"
    assert f"    [*] --> {identity(IDLE)}" in lines


def test_the_picture_needs_nothing_else_to_be_shown() -> None:
    root = ElementTree.fromstring(svg())

    assert root.tag == f"{SVG}svg"
    assert not re.findall(r"(?:href|src|@import|url\((?!#))", svg())


def test_the_picture_writes_every_event_and_every_state() -> None:
    root = ElementTree.fromstring(svg())
    events = [each.text for each in root.iter(f"{SVG}text") if each.get("class") == "event"]
    others = [each.text for each in root.iter(f"{SVG}text") if each.get("class") != "event"]

    assert sorted(map(str, events)) == sorted(row.event.value for row in TRANSITIONS)
    for leaf in LEAVES:
        assert others.count(str(leaf[-1].value)) == sum(leaf[-1] is other[-1] for other in LEAVES)
    assert (
        len([each for each in root.iter(f"{SVG}path") if each.get("class") == "arrow"])
        == len(TRANSITIONS) + 1
    )


def test_boxes_do_not_overlap_and_lie_within_the_picture() -> None:
    layout = lay_out()
    leaves = [box for node, box in layout.boxes.items() if node is None or node in LEAVES]

    for index, one in enumerate(leaves):
        assert 0 <= one.left < one.right <= layout.width
        assert 0 <= one.top < one.bottom <= layout.height
        for other in leaves[index + 1 :]:
            apart_x = one.right <= other.left or other.right <= one.left
            assert apart_x or one.bottom <= other.top or other.bottom <= one.top


@pytest.mark.parametrize("drawn", lay_out().drawn, ids=lambda drawn: drawn.arrow.event.value)
def test_an_arrow_ends_on_the_border_of_its_target(drawn: Drawn) -> None:
    layout = lay_out()
    (x, y), box = drawn.corners[-1], layout.boxes[drawn.arrow.target]

    on_side = x in (box.left, box.right) and box.top < y < box.bottom
    on_top = y == box.top and box.left < x < box.right
    assert on_side or on_top
