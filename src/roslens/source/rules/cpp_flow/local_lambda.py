"""Lambdas that a local variable of C++ holds."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView, all_above


def local_lambda(name: str, node: Node, view: FileView) -> Node | None:
    """Return the lambda that a variable declared before ``node``, in a function around it, is made with."""
    function: Node | None = None
    for one in all_above(node):
        if one.type == "function_definition":
            function = one
            break
    if function is None:
        return None
    found: Node | None = None
    for at in word_places(name.encode(), view, function.start_byte, node.start_byte):
        word = view.node_at(at, at + len(name))
        declared = word.parent if word is not None else None
        if declared is None or declared.type != "init_declarator" or declared.child_by_field_name("declarator") != word:
            continue
        value = declared.child_by_field_name("value")
        found = value if value is not None and value.type == "lambda_expression" else None
    return found


def variable_of(function: Node, view: FileView) -> str:
    """Return the name of the local variable that a lambda is made for; empty where it is made for none."""
    declared = function.parent
    if declared is None or declared.type != "init_declarator" or declared.child_by_field_name("value") != function:
        return ""
    name = view.text(declared.child_by_field_name("declarator"))
    return name if name.isidentifier() else ""


def uses_of(function: Node, view: FileView) -> Iterator[Node]:
    """Yield where the variable that a lambda is made for is named behind it, in the block that declares it."""
    name = variable_of(function, view)
    block = next((one for one in all_above(function) if one.type == "compound_statement"), None)
    if not name or block is None:
        return
    for at in word_places(name.encode(), view, function.end_byte, block.end_byte):
        word = view.node_at(at, at + len(name))
        if word is not None and word.type == "identifier":
            yield word
