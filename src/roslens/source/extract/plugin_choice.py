"""Which plug-ins a node loads, as far as parameters that are set for it decide: what its code is evaluated with again.

A program that loads classes by the names in its parameters (pluginlib, class_loader) makes what these classes make. Its
code alone does not say which they are: what launch files set does, or the defaults of its code.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import msgspec

from roslens.model.errors import DocumentError
from roslens.source.extract.text import Hole, Text
from roslens.source.extract.unknown_lists import listed

if TYPE_CHECKING:
    from roslens.source.extract.abstract_value import Building
    from roslens.source.extract.evaluation import Evaluation
    from roslens.source.extract.node_facts import NodeFacts

_OF_NODE = " of node no. "


class Chosen(msgspec.Struct, frozen=True, array_like=True):
    """Parameters that decide which plug-ins are loaded.

    Attributes:
        values: key of a node, name of its parameter, and what it is set to; None where it has its default.
    """

    values: tuple[tuple[str, str, str | None], ...] = ()

    def has(self, node: Building, name: str) -> bool:
        """Return whether a parameter of a node is one of them."""
        key = node_key(node)
        return any(one[:2] == (key, name) for one in self.values)

    def value(self, node: Building, name: str) -> str | None:
        """Return what a parameter is set to; None where it is not."""
        key = node_key(node)
        return next((one[2] for one in self.values if one[:2] == (key, name)), None)


def node_key(node: Building | NodeFacts) -> str:
    """Return what tells the nodes apart that one evaluation makes; the first one has none."""
    return f"{node.path}:{node.line}:{node.name.pattern}" if node.number else ""


def chosen_value(chosen: Chosen, node: Building, name: str, default: Text | None) -> Any:
    """Return the value of a parameter that decides: a list of texts, or a text; None where nothing tells it.

    What a default says keeps its doubt: it is a hole with that default.
    """
    if not chosen.has(node, name):
        return None
    value = chosen.value(node, name)
    if value is not None:
        if _is_list(value) and "{" in value:
            return _maps(value)
        return [Text.of(one) for one in listed(value)] if _is_list(value) else Text.of(value)
    usual = None if default is None else default.usual
    if usual is None:
        return None
    reason = f"default of parameter {name}"
    if _is_list(usual):
        return [Text((Hole(reason, default=one),)) for one in listed(usual)]
    return Text((Hole(reason, default=usual),))


def deciding_node(engine: Evaluation, text: Text) -> Building:
    """Return the node whose parameters decide a text, else the one whose code is evaluated."""
    for hole in text.holes:
        for reason in (hole.reason, *(one.reason for named in hole.named for one in named.holes)):
            number = reason.rpartition(_OF_NODE)[2] if _OF_NODE in reason else ""
            if number.isdigit() and 0 < int(number) <= len(engine.others):
                return engine.others[int(number) - 1]
        if hole.parameter:
            return engine.first
    node = getattr(engine.frame.self, "node", None)
    return engine.node if node is None else node


def _maps(value: str) -> Any:
    """Return a list of maps as YAML writes it in one line, with texts as keys; None where it is none."""
    from roslens.judge.yaml_tree import Items, Scalar, Table, read_tree

    try:
        root = read_tree(value.encode(), "value").root
    except DocumentError:
        return None
    found: list[Any] = []
    for item in root.nodes if isinstance(root, Items) else ():
        if isinstance(item, Table):
            parts = {key: one.text for key, one in item.nodes.items() if isinstance(one, Scalar)}
            found.append({Text.of(key): Text.of(one) for key, one in parts.items()})
        elif isinstance(item, Scalar):
            found.append(Text.of(item.text))
    return found


def _is_list(value: str) -> bool:
    return value.startswith("[") and value.endswith("]")
