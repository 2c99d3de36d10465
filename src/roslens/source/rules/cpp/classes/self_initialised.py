"""Rule ``cpp.self_initialised``: a member that is initialised with itself."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import function_declarator, name_node, parameters_of
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an initialiser whose only argument is the member itself, and no parameter."""
    if node.named_child_count != 2:
        return
    name = view.text(node.named_children[0])
    values = [view.text(one) for one in node.named_children[1].named_children]
    if values != [name] or not name.isidentifier():
        return
    function = above(node, "function_definition")
    declarator = function_declarator(function) if function is not None else None
    if declarator is None:
        return
    body = function.child_by_field_name("body") if function is not None else None
    if body is not None and re.search(rf"\b{name}\b".encode(), view.code[body.start_byte : body.end_byte]):
        # The body may set it, piece by piece.
        return
    names = {
        view.text(name_node(one.child_by_field_name("declarator"))).lstrip("&* ") for one in parameters_of(declarator)
    }
    if name not in names and not re.search(rf"\b{name}\b", view.text(declarator)):
        yield view.hit(
            "cpp.self_initialised",
            node,
            f"`{view.text(node)}` initialises a member with itself; expected a parameter or a value",
        )


RULE = FileRule(
    id="cpp.self_initialised",
    title="Member initialised with itself",
    finds="`x_(x_)` in the initialisers of a constructor that has no parameter `x_`: the member keeps what was "
    "in memory. Name the parameter.",
    why="A gain or a limit starts with a random number.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "safety",
    ),
    clauses=("cpplint runtime/init",),
    bad="struct A { A(double gain) : gain_(gain_) {} double gain_; };\n",
    good="struct A { A(double gain) : gain_(gain) {} double gain_; };\n",
    syntax="cpp",
    kinds=("field_initializer",),
    found=found,
)
