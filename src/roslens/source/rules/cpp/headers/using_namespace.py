"""Rule ``cpp.using_namespace``: a namespace that is opened in a header."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import has_token
from roslens.source.rules.cpp_statement import is_inside_function
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import HEADER, Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each using directive at the level of a file or namespace."""
    if not has_token(node, "namespace") or is_inside_function(node):
        return
    name = view.text(node.named_children[-1]) if node.named_child_count else ""
    # Literals can be used in no other way.
    if "literals" in name:
        return
    # Placeholders are made to be used so, and collide with nothing.
    certainty = None if name.split("::")[0] == "std" and name != "std::placeholders" else Certainty.HEURISTIC
    message = f"`using namespace {name}` in a header; expected qualified names"
    yield view.hit("cpp.using_namespace", node, message, only=HEADER, certainty=certainty)


RULE = FileRule(
    id="cpp.using_namespace",
    title="`using namespace` in a header",
    finds="A using directive outside of functions in a header. Write the names out, or use it inside of functions. "
    "Other namespaces than `std` are notes, and so are `std::placeholders` and a header below `src` that is not "
    "installed and that one file includes.",
    why="Every file that includes the header gets all names of the namespace; `using namespace std` makes "
    "`count` or `distance` ambiguous in a package far away.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
        "safety",
        "paper2016",
    ),
    tags=("header",),
    clauses=(
        "cpplint build/namespaces_headers",
        "misra-cpp-2008 7-3-6",
        "autosar-cpp14 M7-3-6",
        "hicpp 7.3.1",
        "paper2016 using_directives",
        "clang-tidy google-global-names-in-headers",
    ),
    bad="#pragma once\nusing namespace std;\n",
    good="#pragma once\nusing std::string;\n",
    syntax="cpp",
    kinds=("using_declaration",),
    found=found,
)
