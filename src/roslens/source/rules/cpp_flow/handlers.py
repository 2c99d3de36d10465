"""Handlers of exceptions around a place in C++, and what they catch."""

from __future__ import annotations

from collections.abc import Iterator, Set

from tree_sitter import Node

from roslens.source.rules.file_view import FileView

_FUNCTIONS = ("function_definition", "lambda_expression")
_ALL = "..."
_OTHERS = frozenset(
    (
        *("out_of_range", "invalid_argument", "logic_error", "domain_error", "length_error", "bad_alloc", "bad_cast"),
        *("bad_function_call", "bad_optional_access", "bad_variant_access", "bad_weak_ptr", "system_error"),
        *("range_error", "overflow_error", "underflow_error", "ios_base::failure", "future_error", "regex_error"),
        *("filesystem_error", "RCLError", "ParameterNotDeclaredException", "InvalidParameterTypeException"),
        *("ParameterTypeException", "InvalidParameterValueException", "ParameterAlreadyDeclaredException"),
        *("InvalidNodeError", "UnsupportedEventTypeException", "InvalidNameException", "InvalidNamespaceException"),
    )
)
"""Well-known exceptions that are bases of few others: a type of nobody knows what may be a base of anything."""


def handlers_around(node: Node) -> Iterator[Node]:
    """Yield the handlers of each ``try`` of the same function in whose body a node stands, the innermost first."""
    inner, around = node, node.parent
    while around is not None and around.type not in _FUNCTIONS:
        if around.type == "try_statement" and around.child_by_field_name("body") == inner:
            yield from (one for one in around.children if one.type == "catch_clause")
        inner, around = around, around.parent
    if around is not None and around.type == "function_definition":
        # A function whose body is a ``try``.
        yield from (one for one in around.children if one.type == "catch_clause")


def caught_type(handler: Node, view: FileView) -> str:
    """Return the type that a handler catches, as it is written, ``...`` for all."""
    listed = handler.child_by_field_name("parameters")
    for parameter in listed.named_children if listed is not None else ():
        if parameter.type == "parameter_declaration":
            return view.text(parameter.child_by_field_name("type"))
    return _ALL


def catches(thrown: Set[str], handler: Node, view: FileView) -> bool:
    """Return whether a handler catches any of some types, named without a namespace, or may do so for what is known."""
    last = caught_type(handler, view).rpartition("::")[2]
    return last in thrown or last not in _OTHERS
