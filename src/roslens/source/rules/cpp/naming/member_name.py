"""Rule ``cpp.member_name``: a member that is not named like one."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import members_of, name_node
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each member of a class that is not named like one."""
    for member in members_of(node, view):
        if member.access == "public" or member.node.type != "field_declaration" or member.declarator is not None:
            continue
        named = name_node(member.node.child_by_field_name("declarator"))
        name = view.text(named)
        if named is None or named.type != "field_identifier" or (name.endswith("_") and name == name.lower()):
            continue
        if not any(one.text in (b"static", b"constexpr") for one in member.node.children):
            better = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name.removeprefix("m_")).lower().strip("_") + "_"
            yield view.hit("cpp.member_name", named, f"member `{name}`; expected `{better}`")


RULE = FileRule(
    id="cpp.member_name",
    title="Name of a member",
    finds="A private or protected data member of a class whose name does not end in an underscore, or has a "
    "capital letter.",
    why="Inside of a long function one sees what outlives it.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
    ),
    clauses=("clang-tidy readability-identifier-naming",),
    bad="class A {\n  int maxRate;\n};\n",
    good="class A {\n  int max_rate_;\n};\n",
    syntax="cpp",
    kinds=("class_specifier",),
    found=found,
)
