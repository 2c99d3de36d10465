"""Rule ``cpp.catch_by_value``: a handler that copies what it catches."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each parameter of a handler that is of a class and no reference."""
    for one in (node.child_by_field_name("parameters") or node).named_children:
        kind = one.child_by_field_name("type") if one.type == "parameter_declaration" else None
        if kind is None or kind.type in ("primitive_type", "sized_type_specifier"):
            continue
        declarator = one.child_by_field_name("declarator")
        if declarator is None or declarator.type == "identifier":
            text = view.text(kind)
            yield view.hit(
                "cpp.catch_by_value", one, f"`catch ({view.text(one)})` copies the exception; expected `const {text}&`"
            )


RULE = FileRule(
    id="cpp.catch_by_value",
    title="Exception caught by value",
    finds="`catch (E e)` of a class: the exception is copied, and what a derived class added is cut off. Catch "
    "by `const E&`.",
    why="The message of the error that mattered is lost in the log: `std::exception` alone says nothing.",
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 15-3-5",
        "misra-cpp-2023 18.3.2",
        "autosar-cpp14 A15-3-5",
        "clang-tidy misc-throw-by-value-catch-by-reference",
    ),
    bad="void f() { try { g(); } catch (std::exception e) { log(e.what()); } }\n",
    good="void f() { try { g(); } catch (const std::exception& e) { log(e.what()); } }\n",
    syntax="cpp",
    kinds=("catch_clause",),
    found=found,
)
