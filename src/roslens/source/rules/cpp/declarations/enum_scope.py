"""Rule ``cpp.enum_scope``: an enumeration whose names are everywhere."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import has_token
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each enumeration without a scope."""
    if node.child_by_field_name("body") is not None and not has_token(node, "class") and not has_token(node, "struct"):
        yield view.hit("cpp.enum_scope", node, "`enum` without a scope; expected `enum class`")


RULE = FileRule(
    id="cpp.enum_scope",
    title="Enumeration without a scope",
    finds="An `enum` that is no `enum class`: its names stand in the surroundings, and its values become "
    "numbers. Write `enum class`.",
    why="`IDLE` of two state machines is one name, and comparing them compiles.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2023",
        "autosar-cpp14",
    ),
    clauses=(
        "misra-cpp-2023 10.2.2",
        "autosar-cpp14 A7-2-3",
        "clang-tidy cppcoreguidelines-use-enum-class",
    ),
    bad="enum Mode { ON, OFF };\n",
    good="enum class Mode { ON, OFF };\n",
    syntax="cpp",
    kinds=("enum_specifier",),
    in_c=False,
    found=found,
)
