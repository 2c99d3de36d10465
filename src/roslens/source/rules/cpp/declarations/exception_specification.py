"""Rule ``cpp.exception_specification``: a list of exceptions that is gone."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each specification."""
    text = view.text(node)
    if not text.startswith("noexcept"):
        is_empty = text.replace(" ", "") == "throw()"
        instead = "noexcept" if is_empty else "nothing"
        yield view.hit(
            "cpp.exception_specification",
            node,
            f"`{shortened(text, 60)}` is no C++ any more; expected {instead}",
            certainty=Certainty.HEURISTIC if is_empty else None,
            edits=view.edits((node.start_byte, node.end_byte, "noexcept")) if is_empty else (),
        )


RULE = FileRule(
    id="cpp.exception_specification",
    title="Exception specification",
    finds="`throw (…)` behind a function: removed in C++17, as `throw()` in C++20. Write `noexcept`, or nothing. "
    "In a package that pins an older standard it is a note.",
    why="The package does not compile with the next distribution; before, an exception that is not in the "
    "list ended the process.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "autosar-cpp14",
        "safety",
        "paper2016",
    ),
    clauses=(
        "hicpp 1.3.4",
        "autosar-cpp14 A15-4-1",
        "paper2016 harosThrowSpecification",
        "clang-tidy modernize-use-noexcept",
    ),
    fix="Writes `noexcept` for `throw()`. A list of exceptions is left: what is to become of others takes a person.",
    bad="void f() throw(Error);\n",
    good="void f();\n",
    syntax="cpp",
    kinds=("throw_specifier",),
    found=found,
)
