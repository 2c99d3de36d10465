"""Rule ``cpp.assignment_result``: an assignment that gives something else."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import class_name, members_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each assignment operator whose result is no reference."""
    if view.code.find(b"operator", node.start_byte, node.end_byte) < 0:
        return
    for member in members_of(node, view):
        if member.name.replace(" ", "") != "operator=" or member.is_deleted or member.declarator is None:
            continue
        around = member.declarator.parent
        if around is None or around.type != "reference_declarator":
            kind = view.text(member.node.child_by_field_name("type"))
            yield view.hit(
                "cpp.assignment_result",
                member.declarator,
                f"`operator=` returns {kind or 'nothing'}; expected `{class_name(node, view)}&`",
            )


RULE = FileRule(
    id="cpp.assignment_result",
    title="Assignment operator with another result",
    finds="`operator=` that does not return a reference to its class. Return `*this`.",
    why="`a = b = c` copies, or does not compile.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "autosar-cpp14 A13-2-1",
        "jsf-av 82",
        "clang-tidy misc-unconventional-assign-operator",
    ),
    bad="struct A { void operator=(const A& a); };\n",
    good="struct A { A& operator=(const A& a); };\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    found=found,
)
