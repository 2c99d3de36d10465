"""Rule ``cpp.needless_explicit``: a word that says nothing."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import class_name, has_token, members_of, parameters_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.spans import with_space


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each explicit constructor that takes nothing."""
    if view.code.find(b"explicit", node.start_byte, node.end_byte) < 0:
        return
    name = class_name(node, view)
    for member in members_of(node, view):
        if (
            member.name != name
            or member.declarator is None
            or not has_token(member.node, "explicit_function_specifier")
        ):
            continue
        if not parameters_of(member.declarator) and "..." not in view.text(member.declarator):
            yield view.hit(
                "cpp.needless_explicit",
                member.declarator,
                f"`explicit {view.text(member.declarator)}` takes nothing; expected no `explicit`",
                edits=view.edits(
                    *(
                        (*with_space(view.content, one.start_byte, one.end_byte), "")
                        for one in member.node.children
                        if one.type == "explicit_function_specifier" and view.text(one) == "explicit"
                    )
                ),
            )


RULE = FileRule(
    id="cpp.needless_explicit",
    title="`explicit` without an argument",
    finds="`explicit` on a constructor without parameters. Leave it out.",
    why="It does not compile where `return {};` is written, and says nothing else.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/explicit",
        "paper2016 non_explicit_constructors",
    ),
    fix="Takes `explicit` away.",
    bad="struct A { explicit A(); };\n",
    good="struct A { A(); };\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    found=found,
)
