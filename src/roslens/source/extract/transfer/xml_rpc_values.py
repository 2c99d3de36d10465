"""Values of XML-RPC that code of ROS 1 fills item by item: ``shared["queue_size"] = 5;``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Foreign, Obj, Value
from roslens.source.extract.domain.kinds import known_text, table_of
from roslens.source.extract.symbolic.text import Conditions

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
    name = known_text(key)
    if name:
        ctx.summaries.touch()
        parts = table_of(of.fields.setdefault(_PARTS, {}))
        parts[name] = Part(value, tuple(dict.fromkeys(ctx.state.conditions)))


def parts_of(value: Value) -> Parts:
    """Return the items of a value that code fills; empty of any other one."""
    found: dict[str, Part] = {}
    match value:
        case Obj(type=kind, fields=fields) if kind in XML_RPC:
            for key, part in table_of(fields.get(_PARTS)).items():
                match key, part:
                    case str(), Part():
                        found[key] = part
    return found
