"""A part of a document as a value of JSON: what plain numbers, ``true`` and ``null`` look like, they are."""

from __future__ import annotations

import math
import re

from roslens.judge.documents.yaml_tree import Items, Node, Scalar

Value = bool | int | float | str | list["Value"] | dict[str, "Value"] | None

_WHOLE = re.compile(r"[-+]?\d{1,18}\Z")
_NUMBER = re.compile(r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d{1,3})?\Z")
_WORDS: dict[str, bool] = {"true": True, "false": False}


def plain_value(node: Node) -> Value:
    """Return the value of a node; what stands in quotes is a text, and so are words such as ``no``."""
    if isinstance(node, Items):
        return [plain_value(one) for one in node.nodes]
    if not isinstance(node, Scalar):
        return {key: plain_value(one) for key, one in node.nodes.items()}
    if not node.plain:
        return node.text
    if node.empty:
        return None
    if node.text in _WORDS:
        return _WORDS[node.text]
    if _WHOLE.match(node.text):
        return int(node.text)
    if _NUMBER.match(node.text) and math.isfinite(float(node.text)):
        return float(node.text)
    return node.text
