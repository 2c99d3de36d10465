"""What a parameter that decides which plug-ins are loaded is set to, and which node's parameter it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.errors import DocumentError
from roslens.source.extract.domain.abstract_value import Value
from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.symbolic.reason import node_of_reason
from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.extract.symbolic.text_lists import listed

if TYPE_CHECKING:
    from roslens.source.extract.domain.abstract_value import NodeBuilder
    from roslens.source.extract.transfer.context import Context


def chosen_value(chosen: Chosen, node: NodeBuilder, name: str, default: Text | None) -> Value:
    """Return the value of a parameter that decides: a list of texts, or a text; None if it is unknown.

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


def deciding_node(ctx: Context, text: Text) -> NodeBuilder:
    """Return the node whose parameters decide a text, else the one whose code is evaluated."""
    for hole in text.holes:
        for reason in (hole.reason, *(one.reason for named in hole.named for one in named.holes)):
            if 0 < (number := node_of_reason(reason)) <= len(ctx.emitter.others):
                return ctx.emitter.others[number - 1]
        if hole.parameter:
            return ctx.emitter.first
    node = getattr(ctx.state.frame.self, "node", None)
    return ctx.emitter.node if node is None else node


def _maps(value: str) -> Value:
    """Return a list of maps as YAML writes it in one line, with texts as keys; None where it is none."""
    from roslens.judge.documents.yaml_tree import Items, Scalar, Table, read_tree

    try:
        root = read_tree(value.encode(), "value").root
    except DocumentError:
        return None
    found: list[Value] = []
    match root:
        case Items(nodes=nodes):
            for item in nodes:
                match item:
                    case Table():
                        found.append({Text.of(key): Text.of(one) for key, one in item.texts.items()})
                    case Scalar():
                        found.append(Text.of(item.text))
    return found


def _is_list(value: str) -> bool:
    return value.startswith("[") and value.endswith("]")
