"""Rule ``cpp.function_name``: a function that is not named as the Google guide asks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import class_name, enclosing_class, function_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function that is named otherwise."""
    declarator, named, whole = function_of(node, view)
    name = whole.rpartition("::")[2]
    if named is None or declarator is None or not name.isidentifier() or name == "main" or name.isupper():
        return
    if not name[0].islower():
        return
    cls = whole.rpartition("::")[0].rpartition("::")[2].partition("<")[0]
    if name == cls or name.lower() == name:
        return
    # What stands around a node is asked from the root of the tree on: only where a class has that name.
    if name in _classes(view):
        around = enclosing_class(node)
        if around is not None and name == class_name(around, view):
            return
    yield view.hit("cpp.function_name", named, f"function `{name}`; expected `{name[0].upper() + name[1:]}`")


def _classes(view: FileView) -> frozenset[str]:
    """Return the names of the classes of a file."""
    found = view.kept.get("names of classes")
    if found is None:
        nodes = (*view.nodes("class_specifier"), *view.nodes("struct_specifier"))
        found = view.kept["names of classes"] = frozenset(class_name(one, view) for one in nodes)
    return cast("frozenset[str]", found)


RULE = FileRule(
    id="cpp.function_name",
    title="Name of a function (Google)",
    finds="A function whose name begins with a small letter, but for names without capital letters, which "
    "accessors may have.",
    why="One rule for a whole code base, so that names can be guessed.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=("google",),
    clauses=("clang-tidy readability-identifier-naming",),
    unlike=("cpp.method_name",),
    bad="void stopMotor() {}\n",
    good="void StopMotor() {}\n",
    syntax="cpp",
    kinds=("function_definition",),
    gathers=("class_specifier", "struct_specifier"),
    found=found,
)
