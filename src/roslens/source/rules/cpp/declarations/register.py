"""Rule ``cpp.register``: a storage class that is gone."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.spans import with_space


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such storage class."""
    if node.type == "storage_class_specifier" or (
        node.parent is not None and node.parent.type == "storage_class_specifier"
    ):
        yield view.hit(
            "cpp.register",
            node,
            "`register` was removed in C++17; expected nothing",
            edits=view.edits((*with_space(view.content, node.start_byte, node.end_byte), "")),
        )


RULE = FileRule(
    id="cpp.register",
    title="`register`",
    finds="The storage class `register`. It was removed in C++17: leave it out.",
    why="The package does not compile with the next distribution.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "hicpp 1.3.2",
        "autosar-cpp14 A7-1-4",
        "jsf-av 140",
        "paper2016 harosRegisterKeyword",
        "clang-tidy clang-diagnostic-register",
    ),
    fix="Takes the word away, which compilers have ignored.",
    bad="void f() { register int i = 0; g(i); }\n",
    good="void f() { int i = 0; g(i); }\n",
    syntax="cpp",
    anchors=("register",),
    in_c=False,
    found=found,
)
