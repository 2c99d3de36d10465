"""Rule ``cpp.virtual_destructor``: a class that is made to be derived from, whose destructor is not virtual."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import bases_of, has_token, members_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a class that has virtual functions and no virtual destructor."""
    if view.code.find(b"virtual", node.start_byte, node.end_byte) < 0:
        return
    if node.child_by_field_name("body") is None or has_token(node, "virtual_specifier") or bases_of(node, view):
        return
    virtual = ""
    for member in members_of(node, view):
        if member.name.startswith("~"):
            if member.is_virtual or member.access != "public" or member.is_deleted:
                return
        elif not virtual and member.name and has_token(member.node, "virtual"):
            virtual = member.name
    if virtual:
        name = node.child_by_field_name("name") or node
        yield view.hit(
            "cpp.virtual_destructor",
            name,
            f"class `{view.short(name)}` has virtual `{virtual}` but its destructor is not virtual; "
            "expected `virtual ~…`, or a protected one",
        )


RULE = FileRule(
    id="cpp.virtual_destructor",
    title="Virtual functions without a virtual destructor",
    finds="A class that declares virtual functions, has no base class, and whose destructor is public and not "
    "virtual. Declare `virtual ~Class() = default;`.",
    why="Where a plug-in is deleted through a pointer to its interface, only half of it is destroyed: handles "
    "stay open and threads keep running.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "hicpp 12.2.1",
        "autosar-cpp14 A12-4-1",
        "jsf-av 78",
        "clang-tidy cppcoreguidelines-virtual-class-destructor",
    ),
    bad="class Driver {\n public:\n  virtual void stop();\n};\n",
    good="class Driver {\n public:\n  virtual ~Driver() = default;\n  virtual void stop();\n};\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    found=found,
)
