"""How the vocabulary records that a node writes parameters of ROS 1, and which values."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.source.extract.domain.abstract_value import Obj, Value, as_text
from roslens.source.extract.domain.kinds import table_of
from roslens.source.extract.domain.parameter_types import type_of_value
from roslens.source.extract.facts.node_facts import ParameterFact, Sure
from roslens.source.extract.interpreter.vocabulary import CallSite, below, node_of
from roslens.source.extract.overlays.ros.emit import value_text
from roslens.source.extract.symbolic.text import Conditions, Text, unknown
from roslens.source.extract.transfer.xml_rpc_values import parts_of

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


def write_parameter(
    ctx: Context, receiver: Value, called: CallSite, name: Value, value: Value, conditions: Conditions = ()
) -> None:
    """Record that a parameter is written; of a dictionary each item is a parameter of its own.

    ``conditions`` are those of its value, besides those around the call.

    What is written while the node runs is only likely to be there, as nobody knows when that is.
    """
    written = below(receiver, as_text(name))
    items = _by_name(value)
    for inner, item in items:
        write_parameter(ctx, receiver, called, Text.of(as_text(name), "/", inner), item)
    if items:
        return
    parts = parts_of(value)
    for key, part in parts.items():
        write_parameter(
            ctx, receiver, called, Text.of(as_text(name), "/", key), part.value, (*conditions, *part.conditions)
        )
    if parts:
        return
    match value:
        case None | dict() | Obj():
            text = unknown("a structured value")
        case _:
            text = value_text(value)
    writer = called.evidence
    if ctx.callbacks.running:
        writer = msgspec.structs.replace(writer, how="while the node runs", sure=Sure.LIKELY)
    fact = ParameterFact(
        written,
        called.evidence,
        "written",
        "" if text.holes else type_of_value(value),
        conditions=tuple(dict.fromkeys((*conditions, *ctx.state.conditions))),
        value=text,
        writer=writer,
    )
    node = node_of(ctx, receiver)
    if fact not in node.parameters:
        node.parameters.append(fact)


def _by_name(value: Value) -> list[tuple[str | Text, Value]]:
    """Return the items of a table whose keys are texts; none of any other value."""
    found: list[tuple[str | Text, Value]] = []
    for key, item in table_of(value).items():
        match key:
            case Text() | str():
                found.append((key, item))
            case _:
                return []
    return found
