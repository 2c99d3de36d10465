"""Pointers of C++ that own: what ``std::shared_ptr<Node>(this, [](Node *) {})`` and its like point to."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.source.extract.domain.abstract_value import Callable, Value
from roslens.source.extract.ir.type_names import POINTER_NAMES

OWNERS = frozenset(f"{space}{kind}_ptr" for space in ("std.", "boost.", "") for kind in ("shared", "unique", "scoped"))


def owns_first(arguments: Sequence[Value]) -> bool:
    """Return whether a pointer points to the first thing it is made of: alone, or with a function that deletes it."""
    match arguments:
        case [_] | [_, Callable()]:
            return True
    return False


def is_owner(name: str) -> bool:
    """Return whether a class outside of the workspace is a pointer by its name, as ``rclcpp.Node.SharedPtr``."""
    return name.endswith("Ptr") and name.rpartition(".")[2] in POINTER_NAMES
