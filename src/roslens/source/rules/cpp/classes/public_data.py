"""Rule ``cpp.public_data``: data that anybody may change."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import members_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each data member that others may change."""
    for member in members_of(node, view):
        if member.access == "private" or member.node.type != "field_declaration" or member.declarator is not None:
            continue
        words = {
            view.text(one) for one in member.node.children if one.type in ("type_qualifier", "storage_class_specifier")
        }
        declarator = member.node.child_by_field_name("declarator")
        if words & {"const", "static", "constexpr"} or declarator is None or "(" in view.text(declarator):
            continue
        yield view.hit(
            "cpp.public_data",
            member.node,
            f"`{view.short(member.node)}` is {member.access}; expected private",
        )


RULE = FileRule(
    id="cpp.public_data",
    title="Public data of a class",
    finds="A data member of a `class` (not of a `struct`) that is public or protected and neither const nor "
    "static. Make it private.",
    why="A limit is changed behind the back of the function that checks it.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 11-0-1",
        "misra-cpp-2023 14.1.1",
        "autosar-cpp14 M11-0-1",
        "jsf-av 67",
        "hicpp 11.1.1",
        "clang-tidy misc-non-private-member-variables-in-classes",
    ),
    bad="class A {\n public:\n  double limit;\n};\n",
    good="class A {\n  double limit_;\n};\n",
    syntax="cpp",
    kinds=("class_specifier",),
    found=found,
)
