"""Rule ``cpp.non_const_reference``: an argument that the call does not show to change."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import has_token, name_node
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_STREAMS = re.compile(r"stream\b|Archive\b|archive\b")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each parameter that is a reference to what may change."""
    declarator = node.child_by_field_name("declarator")
    if declarator is None or view.code.find(b"const", node.start_byte, declarator.start_byte) >= 0:
        return
    if not has_token(declarator, "&"):
        return
    kind = view.text(node.child_by_field_name("type"))
    if any(one.type == "type_qualifier" and one.text == b"const" for one in node.children) or _STREAMS.search(kind):
        return
    function = above(node, "function_declarator", "lambda_expression")
    name = view.text(name_node(function)) if function is not None and function.type == "function_declarator" else ""
    if name and name.rpartition("::")[2] != "swap" and not name.rpartition("::")[2].startswith("operator"):
        yield view.hit(
            "cpp.non_const_reference",
            node,
            f"`{view.short(node)}` may change; expected const, a pointer or a result",
        )


RULE = FileRule(
    id="cpp.non_const_reference",
    title="Parameter that is a reference and not const",
    finds="A reference that is not `const` as a parameter, but of streams. Return a value, or take a pointer, "
    "as older versions of the Google guide ask.",
    why="A reader of `update(pose)` does not see that it changes the pose.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=("paper2016",),
    clauses=(
        "cpplint runtime/references",
        "paper2016 non_const_ref",
    ),
    bad="void f(int& a);\n",
    good="int f(int a);\n",
    syntax="cpp",
    kinds=("(parameter_declaration declarator: (reference_declarator)) @node",),
    found=found,
)
