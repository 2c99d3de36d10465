"""Which parameters a class of a Python file declares, where all of them are written out."""

from __future__ import annotations

import re

from tree_sitter import Node

from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import arguments, keywords, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import PythonClass, PythonFunctions
from roslens.source.rules.node.base.derived_node import is_derived_node

_OPEN = re.compile(rb"allow_undeclared|automatically_declare|declare_parameters\b|ParamListener|generate_parameter")
_DECLARES = re.compile(r"declare|param", re.IGNORECASE)
_HARMLESS = frozenset({
    "ActionServer", "ActionClient", "TransformListener", "TransformBroadcaster", "StaticTransformBroadcaster",
    "Subscriber", "Rate", "spin", "spin_once", "spin_until_future_complete", "add_node", "super", "__init__", "Buffer",
    "isinstance", "print", "str", "partial",
})  # fmt: skip
"""Calls that get the node and declare nothing."""


def declared_names(of: PythonClass, functions: PythonFunctions, view: FileView) -> frozenset[str]:
    """Return the names that are declared in the file, for a class derived from the node of rclpy alone.

    Empty where the class is none, or where anything else may declare parameters of its nodes.
    """
    if (
        not is_derived_node(of, view)
        or view.has(_OPEN)
        or any(of.name in one.bases for one in functions.classes.values())
    ):
        return frozenset()
    found: set[str] = set()
    for call in functions.calls:
        name, given = callee_name(call, view), arguments(call)
        if name == "declare_parameter":
            written = given[0] if given else keywords(call, view).get("name")
            if written is None or written.type != "string" or view.text(written)[:1] not in "'\"":
                return frozenset()
            found.add(view.text(written).strip("'\""))
        elif _may_declare(call, name, functions, view):
            return frozenset()
    return frozenset(found)


def _may_declare(call: Node, name: str, functions: PythonFunctions, view: FileView) -> bool:
    """Return whether a call may declare parameters of the node by other means."""
    of_self = functions.is_self(receiver(call))
    if "declare" in name or (
        not of_self and _DECLARES.search(name) and "get_param" not in name and "set_param" not in name
    ):
        return True
    values = (*arguments(call), *keywords(call, view).values())
    return name not in _HARMLESS and any(functions.is_self(one) for one in values)
