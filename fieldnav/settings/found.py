"""What a dotted key of a settings file stands for, as its model has it."""

from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from types import UnionType
from typing import Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

UNIONS = (UnionType, Union)
"""Both are written `A | B`; which one it is depends on what A is."""


class Found:
    """What a dotted key stands for: its type, its bounds and what it is."""

    def __init__(self, kind: Any, constraints: Sequence[Any] = (), description: str | None = None) -> None:
        while hasattr(kind, "__metadata__"):
            constraints = [*constraints, *_flattened(kind.__metadata__)]
            kind = get_args(kind)[0]
        self.kind, self.constraints, self.description = kind, list(constraints), description

    def child(self, part: int | str) -> "Found":
        if is_model(self.kind):
            fields: Mapping[str, FieldInfo] = self.kind.model_fields
            field = fields.get(str(part))
            return Found(field.annotation, field.metadata, field.description) if field else Found(Any)
        arguments = get_args(self.kind)
        if get_origin(self.kind) is dict:
            return Found(arguments[1])
        if get_origin(self.kind) is tuple and arguments[-1] is Ellipsis:
            return Found(arguments[0])
        if get_origin(self.kind) is tuple and isinstance(part, int) and part < len(arguments):
            return Found(arguments[part])
        return Found(Any)


def find(model: type[BaseModel], location: Sequence[int | str]) -> Found:
    found = Found(model)
    for part in location:
        found = found.child(part)
    return found


def _flattened(metadata: Sequence[Any]) -> Iterator[Any]:
    for item in metadata:
        yield from item.metadata if isinstance(item, FieldInfo) else [item]


def known_part(model: type[BaseModel], location: Sequence[int | str]) -> list[int | str]:
    """The location up to where several kinds of value are allowed; beyond, pydantic names those it tried."""
    found, known = Found(model), []
    for part in location:
        if get_origin(found.kind) in UNIONS:
            break
        known.append(part)
        found = found.child(part)
    return known


def is_enum(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, Enum)


def is_model(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, BaseModel)
