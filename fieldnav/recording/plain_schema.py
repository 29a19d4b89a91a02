"""A JSON schema without references and alternatives: Foxglove refuses a topic whose schema has any."""

from collections.abc import Mapping
from typing import Any

Node = Mapping[str, Any]
KEPT = ("description", "format")


def plain_schema(schema: Node) -> dict[str, Any]:
    """The same schema spelled out: every value has one type. That a value may also be null is not said."""
    return _plain(schema, schema.get("$defs", {}))


def _plain(node: Node, known: Node) -> dict[str, Any]:
    node = _meant(node, known)
    kind = node.get("type", "string")
    plain = {"type": kind} | {key: node[key] for key in KEPT if key in node}
    if kind == "object":
        plain["properties"] = {name: _plain(value, known) for name, value in _values(node, known).items()}
    elif kind == "array":
        plain["items"] = _plain(node.get("items", {}), known)
    return plain


def _meant(node: Node, known: Node) -> Node:
    """A reference followed, and of alternatives the first that is not null."""
    while "$ref" in node or "anyOf" in node:
        if "$ref" in node:
            node = known[node["$ref"].rpartition("/")[2]]
        else:
            node = next(one for one in node["anyOf"] if one.get("type") != "null")
    return node


def _values(node: Node, known: Node) -> Node:
    """What an object holds by name; of a mapping, a value for each name that it may have."""
    if "propertyNames" in node:
        names = _meant(node["propertyNames"], known).get("enum", ())
        return dict.fromkeys(names, node["additionalProperties"])
    values: Node = node.get("properties", {})
    return values
