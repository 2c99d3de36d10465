"""Rule ``cpp.removed_library``: a part of the library that is gone."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ADAPTERS = frozenset(
    (
        *("bind1st", "bind2nd", "mem_fun", "mem_fun_ref", "ptr_fun"),
        *("unary_function", "binary_function"),
    )
)
"""What GCC still has in C++17 and later, and what does there what it always did."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each name that is written with ``std::``."""
    if _is_asked_for(view, view.text(node)):
        return
    if view.code[: node.start_byte].rstrip()[-5:] == b"std::" and node.type in ("identifier", "type_identifier"):
        name = view.text(node)
        still = "" if name == "unexpected_handler" else ", and is deprecated where a compiler still has it, as GCC does"
        yield view.hit(
            "cpp.removed_library",
            node,
            f"`std::{name}` was removed in C++17{still}; expected what replaces it",
            certainty=Certainty.HEURISTIC if name in _ADAPTERS else None,
        )


def _is_asked_for(view: FileView, name: str) -> bool:
    """Tell whether a condition of the preprocessor names it: it is there only where the library has it."""
    return re.search(rb"#[ \t]*(?:el)?if[^\n]*%s" % name.upper().encode(), view.code) is not None


RULE = FileRule(
    id="cpp.removed_library",
    title="Part of the standard library that was removed",
    finds="`std::auto_ptr`, `std::random_shuffle`, `std::bind1st`, `std::bind2nd`, `std::mem_fun`, "
    "`std::mem_fun_ref`, `std::ptr_fun`, `std::unary_function`, `std::binary_function` and "
    "`std::unexpected_handler` were removed in C++17. Use `std::unique_ptr`, `std::shuffle`, lambdas. "
    "It is a note in a package that is neither for ROS 2 nor asks for C++17, and of what binds and adapts functions, "
    "which GCC still has.",
    why="Compilers with another library, such as libc++, refuse it, and GCC warns; `std::auto_ptr` also moves where it "
    "seems to copy.",
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
        "hicpp 1.3.3",
        "autosar-cpp14 A18-1-3",
        "paper2016 harosDeprecatedSTL",
        "clang-tidy modernize-replace-auto-ptr",
    ),
    bad="std::auto_ptr<int> p;\n",
    good="std::unique_ptr<int> p;\n",
    syntax="cpp",
    anchors=(
        "auto_ptr",
        "random_shuffle",
        "bind1st",
        "bind2nd",
        "mem_fun",
        "mem_fun_ref",
        "ptr_fun",
        "unary_function",
        "binary_function",
        "unexpected_handler",
    ),
    found=found,
)
