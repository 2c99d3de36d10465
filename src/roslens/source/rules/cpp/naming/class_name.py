"""Rule ``cpp.class_name``: a class that is not named like one."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each class that begins with a small letter or holds an underscore."""
    named = node.child_by_field_name("name")
    if node.child_by_field_name("body") is None or named is None or named.type != "type_identifier":
        return
    name = view.text(named)
    if not name.endswith("_t") and (name[0].islower() or "_" in name.strip("_")):
        better = "".join(part[:1].upper() + part[1:] for part in name.split("_"))
        yield view.hit("cpp.class_name", named, f"class `{name}`; expected `{better}`")


RULE = FileRule(
    id="cpp.class_name",
    title="Name of a class",
    finds="A class, struct or enumeration whose name is not `CamelCased`; names that end in `_t` and traits in "
    "`detail` are let be.",
    why="The guides of ROS 1, ROS 2 and Google agree on it: the first letter distinguishes types from variables.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
    ),
    clauses=("clang-tidy readability-identifier-naming",),
    bad="class motor_driver {};\n",
    good="class MotorDriver {};\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier", "enum_specifier"),
    found=found,
)
