"""Rule ``cpp.method_name``: a function that is not named as the ROS 1 guide asks."""

from __future__ import annotations

from collections.abc import Iterator

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
    if not name[0].isupper():
        return
    cls = whole.rpartition("::")[0].rpartition("::")[2].partition("<")[0]
    around = enclosing_class(node)
    if name == cls or (around is not None and name == class_name(around, view)):
        return
    yield view.hit("cpp.method_name", named, f"function `{name}`; expected `{name[0].lower() + name[1:]}`")


RULE = FileRule(
    id="cpp.method_name",
    title="Name of a function (ROS)",
    finds="A function whose name begins with a capital letter. The guides of ROS ask for `camelCased` (ROS 1), "
    "or `under_scored` (ROS 2).",
    why="One rule for a whole code base, so that names can be guessed.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=("ros-style",),
    clauses=("clang-tidy readability-identifier-naming",),
    unlike=("cpp.function_name",),
    bad="void StopMotor() {}\n",
    good="void stopMotor() {}\n",
    syntax="cpp",
    kinds=("function_definition",),
    found=found,
)
