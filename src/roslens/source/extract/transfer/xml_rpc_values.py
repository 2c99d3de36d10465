"""Values of XML-RPC that code of ROS 1 fills item by item: ``shared["queue_size"] = 5;``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roslens.source.extract.domain.abstract_value import Obj
from roslens.source.extract.symbolic.text import Conditions, Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

XML_RPC = frozenset({"XmlRpc.XmlRpcValue", "XmlRpcValue"})
_PARTS = "its parts"

Parts = dict[str, tuple[Any, Conditions]]
"""Items by name, each with the conditions under which it was put there."""


def put_part(engine: Context, of: Obj, key: Any, value: Any) -> None:
    """Put an item into a value; what has no known name is left out."""
    if isinstance(key, Text) and key.known:
        engine.touched()
        parts: Parts = of.fields.setdefault(_PARTS, {})
        parts[key.known] = (value, tuple(dict.fromkeys(engine.conditions)))


def parts_of(value: Any) -> Parts:
    """Return the items of a value that code fills; empty of any other one."""
    found = value.fields.get(_PARTS) if isinstance(value, Obj) and value.type in XML_RPC else None
    return found if isinstance(found, dict) else {}
