"""Rule ``cpp.string_reference``: a reference to a text that may be gone."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import members_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_REFERENCE = re.compile(rb"string\s*&\s*\w+\s*;")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each member that is a reference to a constant string."""
    if not _REFERENCE.search(view.code, node.start_byte, node.end_byte):
        return
    for member in members_of(node, view):
        declarator = member.node.child_by_field_name("declarator")
        if member.node.type != "field_declaration" or declarator is None or declarator.type != "reference_declarator":
            continue
        is_const = any(one.text == b"const" for one in member.node.children)
        kind = view.text(member.node.child_by_field_name("type"))
        if member.declarator is None and is_const and kind in ("std::string", "string"):
            yield view.hit(
                "cpp.string_reference",
                member.node,
                f"`{view.short(member.node)}` may refer to a text that is gone; expected the string itself",
            )


RULE = FileRule(
    id="cpp.string_reference",
    title="Member that is a reference to a string",
    finds="A member `const std::string&`: built from a literal or a temporary, it refers to nothing. Keep the "
    "string itself.",
    why="The name of a frame or topic turns into garbage some time later.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "google",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/member_string_references",
        "paper2016 const_string_ref",
        "clang-tidy cppcoreguidelines-avoid-const-or-ref-data-members",
    ),
    bad="struct A { const std::string& name; };\n",
    good="struct A { const std::string name; };\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    found=found,
)
