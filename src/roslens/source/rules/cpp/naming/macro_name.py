"""Rule ``cpp.macro_name``: a macro that is not named like one."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each macro with a small letter that is no renaming of a keyword."""
    name = view.text(node.child_by_field_name("name"))
    value = view.text(node.child_by_field_name("value"))
    if (
        name != name.upper()
        and value
        and not name.startswith("_")
        and name not in ("private", "protected", "final", "override")
    ):
        better = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).upper()
        yield view.hit_at("cpp.macro_name", view.place(node.start_byte)[0], f"macro `{name}`; expected `{better}`")


RULE = FileRule(
    id="cpp.macro_name",
    title="Name of a macro",
    finds="A macro whose name has small letters.",
    why="A macro that looks like a function is called like one, with arguments that are evaluated twice.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
    ),
    clauses=("clang-tidy readability-identifier-naming",),
    bad="#define maxRate 3\n",
    good="#define MAX_RATE 3\n",
    syntax="cpp",
    kinds=("preproc_def", "preproc_function_def"),
    found=found,
)
