"""Values of XML-RPC that code of ROS 1 fills item by item: ``shared["queue_size"] = 5;``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Foreign, Obj, Value
from roslens.source.extract.symbolic.text import Conditions, Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

XML_RPC = frozenset({"XmlRpc.XmlRpcValue", "XmlRpcValue"})
_PARTS = "its parts"


class Part(Foreign, frozen=True):
    """An item, and the conditions under which it was put there."""

    value: Value
    conditions: Conditions


Parts = dict[str, Part]
"""Items by name."""


def put_part(ctx: Context, of: Obj, key: Value, value: Value) -> None:
    """Put an item into a value; what has no known name is left out."""
    if isinstance(key, Text) and key.known:
        ctx.summaries.touch()
        parts = of.fields.setdefault(_PARTS, {})
        if isinstance(parts, dict):
            parts[key.known] = Part(value, tuple(dict.fromkeys(ctx.state.conditions)))


def parts_of(value: Value) -> Parts:
    """Return the items of a value that code fills; empty of any other one."""
    found = value.fields.get(_PARTS) if isinstance(value, Obj) and value.type in XML_RPC else None
    parts = found.items() if isinstance(found, dict) else ()
    return {key: part for key, part in parts if isinstance(key, str) and isinstance(part, Part)}
