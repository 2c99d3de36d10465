"""Rule ``cpp.vexing_parse``: a variable that is a function by mistake."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import function_declarator, has_token, name_node
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_MACRO = re.compile(r"[A-Z][A-Z0-9_]*")
_PLAIN = ("primitive_type", "sized_type_specifier")
"""Types of numbers, which have no constructor to call: this declares a function on purpose."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each declaration in a block of a function without parameters."""
    declarator = node.child_by_field_name("declarator")
    if (
        declarator is None
        or declarator.type != "function_declarator"
        or view.code[declarator.end_byte - 1 : declarator.end_byte] != b")"
    ):
        return
    kind, parameters = node.child_by_field_name("type"), declarator.child_by_field_name("parameters")
    block = node.parent
    if block is None or block.type != "compound_statement" or parameters is None or parameters.child_count != 2:
        return
    text, name = view.text(kind), view.text(name_node(declarator))
    if (
        not name.isidentifier()
        or name.isupper()
        or text in ("", "void", "extern", "emit")
        or has_token(node, "storage_class_specifier")
    ):
        return
    function = above(node, "function_definition", "lambda_expression")
    # A class behind a macro looks like a function, and so may a macro on a line of its own like a type.
    if function is None or _MACRO.fullmatch(text) or (kind is not None and kind.type in _PLAIN):
        return
    if function.type == "function_definition" and function_declarator(function) is None:
        return
    # What is called later in the block is a function.
    if re.search(rb"\b%s\s*\(" % name.encode(), view.code[node.end_byte : block.end_byte]):
        return
    yield view.hit("cpp.vexing_parse", node, f"`{view.short(node)}` declares a function; expected `{text} {name};`")


RULE = FileRule(
    id="cpp.vexing_parse",
    title="Variable that is declared as a function",
    finds="`Type name();` inside of a function declares a function, no variable. Write `Type name;` or `Type name{};`.",
    why="The object that was meant, such as a lock or a node handle, never exists.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "hicpp 3.2.1",
        "misra-cpp-2008 3-1-2",
        "autosar-cpp14 M3-1-2",
        "clang-tidy clang-diagnostic-vexing-parse",
    ),
    bad="void f() { std::mutex lock(); }\n",
    good="void f() { std::mutex lock; }\n",
    syntax="cpp",
    kinds=("(declaration declarator: (function_declarator)) @node",),
    found=found,
)
