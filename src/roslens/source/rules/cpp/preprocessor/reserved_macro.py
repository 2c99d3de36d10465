"""Rule ``cpp.reserved_macro``: a name that belongs to the compiler."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_RESERVED = re.compile(r"__|_[A-Z]")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such macro that is defined."""
    name = view.text(node.child_by_field_name("name"))
    if _RESERVED.match(name) and not name.startswith(
        ("_USE_MATH", "_GNU_SOURCE", "_POSIX", "_CRT_", "_WIN32", "_BSD", "_XOPEN")
    ):
        yield view.hit_at(
            "cpp.reserved_macro",
            view.place(node.start_byte)[0],
            f"`{name}` is reserved for the compiler; expected another name",
        )


RULE = FileRule(
    id="cpp.reserved_macro",
    title="Macro with a reserved name",
    finds="A macro whose name begins with two underscores, or with one and a capital letter. Such names belong "
    "to the compiler and its library.",
    why="The next version of the compiler uses the name for itself.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 17-0-1",
        "autosar-cpp14 A17-0-1",
        "jsf-av 47",
        "clang-tidy bugprone-reserved-identifier",
    ),
    bad="#define __LIMIT 3\n",
    good="#define ROBOT_LIMIT 3\n",
    syntax="cpp",
    kinds=("preproc_def", "preproc_function_def"),
    found=found,
)
