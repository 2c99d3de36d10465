"""Rule ``cpp.raw_new``: an object that nobody owns."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_OWNERS = re.compile(r"(?:_ptr|Ptr|_array|unique|shared|reset|Handle|SharedPtr|UniquePtr)\b[^;=]*$")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each new object that goes to no smart pointer."""
    statement = above(
        node, "expression_statement", "declaration", "return_statement", "field_initializer", "field_declaration"
    )
    placed = next((one for one in node.named_children if one.type == "argument_list"), None)
    if statement is None or (placed is not None and placed == node.named_children[0]):
        return
    before = view.code[statement.start_byte : node.start_byte].decode("utf-8", "replace")
    if not re.search(r"_ptr|Ptr|reset|unique|shared|Q[A-Z]|set\w*Delete", before):
        yield view.hit(
            "cpp.raw_new",
            node,
            f"`{view.short(node)}` has no owner; expected std::make_unique or std::make_shared",
        )


RULE = FileRule(
    id="cpp.raw_new",
    title="`new` without an owner",
    finds="`new` whose result goes to a plain pointer. Use `std::make_unique` or `std::make_shared`; what is "
    "handed to a smart pointer or placed in memory is let be.",
    why="An exception or an early return loses the object, and what it holds open.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
    ),
    clauses=(
        "misra-cpp-2023 21.6.2",
        "autosar-cpp14 A18-5-2",
        "hicpp 5.3.2",
        "clang-tidy cppcoreguidelines-owning-memory",
    ),
    bad="void f() { A* a = new A(3); g(a); }\n",
    good="void f() { auto a = std::make_unique<A>(3); g(a); }\n",
    syntax="cpp",
    kinds=("new_expression",),
    found=found,
)
