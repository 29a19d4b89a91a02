"""The part of YAML that settings need: mappings, lists, text, numbers, true and false."""

import unicodedata
from collections.abc import Hashable
from typing import Any

import yaml
from yaml.constructor import ConstructorError

from fieldnav.settings.problems import shortened
from fieldnav.settings.scalars import AMBIGUOUS, RESOLVERS, STRING, advice
from fieldnav.settings.shown_source import is_secret

DEEPEST_NESTING = 20
"""Levels of a document; settings have four."""
LONGEST_NUMBER = 40
"""Characters of a number; more is a slip of the keyboard and takes long to convert."""

_WRITTEN_OUT = "; write the values out"
_LINE_BREAKS_AND_TABS = "\n\r\t"
_NOT_TEXT = ("Cc", "Cs")
"""Unicode's categories of control characters and of halves of a character."""


class RefusedError(yaml.MarkedYAMLError):
    """Valid YAML that settings must not hold."""


class StrictLoader(yaml.SafeLoader):
    """The safe loader without what settings need not: sharing, tags, dates, a key given twice.

    Without sharing a document is no larger than its file and no value holds itself.
    """

    yaml_implicit_resolvers = RESOLVERS  # instead of the library's guesses, which are those of YAML 1.1

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._depth = 0
        self._path: list[str] = []

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        """Refuse what is too late to refuse in the finished document; a key is the text it is written as."""
        event = self.peek_event()  # type: ignore[no-untyped-call]  # yaml is typed in part
        self._depth += 1
        if problem := self._problem(event):
            raise RefusedError(problem=problem, problem_mark=event.start_mark)
        self._path.append(str(index.value if isinstance(index, yaml.ScalarNode) else index))
        node = super().compose_node(parent, index)
        if isinstance(node, yaml.ScalarNode):
            if isinstance(parent, yaml.MappingNode) and index is None:
                node.tag = STRING
            self._check_scalar(node)
        self._path.pop()
        self._depth -= 1
        return node

    def _check_scalar(self, node: yaml.ScalarNode) -> None:
        """Raises RefusedError for a value that could be taken for another one, with its key."""
        if node.tag == STRING:
            return
        self._check_length(node)
        if node.tag == AMBIGUOUS:
            key = shortened(".".join(self._path[1:]))
            said = "is not allowed as it is; write it in quotes" if is_secret(key) else advice(node.value)
            problem = f"{key}: {said}" if key else said
            raise RefusedError(problem=problem, problem_mark=node.start_mark)

    def _problem(self, event: Any) -> str:
        anchor, tag = getattr(event, "anchor", None), getattr(event, "tag", None)
        if isinstance(event, yaml.AliasEvent):
            return f"allowed is no alias (*{anchor}){_WRITTEN_OUT}"
        if anchor is not None:
            return f"allowed is no anchor (&{anchor}){_WRITTEN_OUT}"
        if tag is not None:
            return f"allowed is no tag ({tag.replace('tag:yaml.org,2002:', '!!')}); write the plain value"
        return f"is nested more than {DEEPEST_NESTING} deep" if self._depth > DEEPEST_NESTING else ""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        seen: set[Hashable] = set()
        for key_node, _ in node.value:
            mark = key_node.start_mark
            if not isinstance(key_node, yaml.ScalarNode):
                raise RefusedError(problem="a list or a mapping cannot be a key", problem_mark=mark)
            if key_node.value == "<<":
                raise RefusedError(problem=f"allowed is no merge key (<<){_WRITTEN_OUT}", problem_mark=mark)
            key = self.construct_object(key_node, deep=True)
            if key in seen:
                raise ConstructorError(problem=f"key '{key}' is given twice", problem_mark=mark)
            seen.add(key)
        return super().construct_mapping(node, deep)

    def construct_yaml_str(self, node: yaml.ScalarNode) -> str:
        """Text; what could stand in no file name and on no terminal is refused."""
        text = str(self.construct_scalar(node))
        bad = next((each for each in text if _is_no_text(each)), None)
        if bad is not None:
            raise RefusedError(
                problem=f"allowed is no control character (\\u{ord(bad):04x}) in text",
                problem_mark=node.start_mark,
            )
        return text

    def construct_yaml_int(self, node: yaml.ScalarNode) -> int:
        return int(node.value)

    def _check_length(self, node: yaml.ScalarNode) -> None:
        if len(node.value) > LONGEST_NUMBER:
            found = f"a number of {len(node.value)} characters"
            raise RefusedError(
                problem=f"{found}; allowed are at most {LONGEST_NUMBER}", problem_mark=node.start_mark
            )


def _is_no_text(character: str) -> bool:
    return unicodedata.category(character) in _NOT_TEXT and character not in _LINE_BREAKS_AND_TABS


for _name in ("str", "int"):
    StrictLoader.add_constructor(
        f"tag:yaml.org,2002:{_name}", getattr(StrictLoader, f"construct_yaml_{_name}")
    )
