"""Rule ``cpp.variable_name``: a variable that is not named like one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_declaration import Declaration, declarations
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_CONSTANT = re.compile(r"k[A-Z]\w*|[A-Z0-9_]+")


def found_among(_nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each local variable with a capital letter."""
    for declaration in declarations(view).values():
        yield from _found(declaration, view)


def _found(declaration: Declaration, view: FileView) -> Iterator[Hit]:
    for one, named, name in declaration.names:
        if named is None or name == name.lower() or _CONSTANT.fullmatch(name):
            continue
        around = declaration.node.parent
        if around is None or around.type not in ("compound_statement", "for_statement", "case_statement"):
            return
        if named.type == "identifier" and one.type != "function_declarator":
            better = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
            yield view.hit("cpp.variable_name", named, f"variable `{name}`; expected `{better}`")


RULE = FileRule(
    id="cpp.variable_name",
    title="Name of a variable",
    finds="A local variable whose name holds a capital letter, but for constants (`kLimit`, `LIMIT`).",
    why="The guides of ROS and Google agree on `under_scored` names: variables are distinguished from types and "
    "functions at a glance.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
    ),
    clauses=("clang-tidy readability-identifier-naming",),
    bad="void f() { int maxRate = 3; g(maxRate); }\n",
    good="void f() { int max_rate = 3; g(max_rate); }\n",
    syntax="cpp",
    kinds=("declaration",),
    found_among=found_among,
)
