"""Rule ``cpp.surplus_semicolon``: a semicolon that ends nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_BEHIND = re.compile(rb"\}[ \t]*(;)")
_NEEDLESS = frozenset(
    (
        *("function_definition", "namespace_definition", "if_statement", "for_statement", "while_statement"),
        *("for_range_loop", "switch_statement", "try_statement", "compound_statement", "linkage_specification"),
    )
)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each semicolon behind something that needs none."""
    for match, node in places(_BEHIND, view, 1):
        one = _outermost(node, match.span(1))
        around = one.parent
        if around is not None and _is_function(around, one):
            yield view.hit(
                "cpp.surplus_semicolon", one, "`;` behind this function; expected nothing", edits=_edits(match, view)
            )
            continue
        before = one.prev_named_sibling
        while before is not None and before.type == "comment":
            before = before.prev_named_sibling
        if before is not None and before.type in _NEEDLESS and before.end_byte <= match.start(1):
            what = before.type.rpartition("_")[0].replace("_", " ")
            edits = _edits(match, view) if view.is_as_written(before) else ()
            yield view.hit("cpp.surplus_semicolon", one, f"`;` behind this {what}; expected nothing", edits=edits)


def _outermost(node: Node, place: tuple[int, int]) -> Node:
    """Return the outermost node that is nothing but the semicolon at a place."""
    while node.parent is not None and node.parent.byte_range == place:
        node = node.parent
    return node


def _edits(match: re.Match[bytes], view: FileView) -> tuple[Edit, ...]:
    return view.edits((match.start() + 1, match.end(), ""))


def _is_function(declaration: Node, semicolon: Node) -> bool:
    """Return whether it is an empty function that the semicolon makes look like a variable with an initialiser."""
    if declaration.type not in ("declaration", "field_declaration") or semicolon.prev_named_sibling is None:
        return False
    last = semicolon.prev_named_sibling
    declarator = last.child_by_field_name("declarator") if last.type == "init_declarator" else last.prev_named_sibling
    value = last.named_children[-1] if last.type == "init_declarator" else last
    is_empty = value.type == "initializer_list" and not value.named_child_count
    return is_empty and declarator is not None and declarator.type == "function_declarator"


RULE = FileRule(
    id="cpp.surplus_semicolon",
    title="Semicolon behind a brace",
    finds="A `;` behind the closing brace of a function, namespace, branch or loop. Remove it.",
    why="It is an empty statement: behind an `if` it takes the `else` away.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/braces",
        "paper2016 redundant_empty_statement",
        "clang-tidy clang-diagnostic-extra-semi",
    ),
    fix="Takes the semicolon away.",
    bad="void f() {};\n",
    good="void f() {}\n",
    syntax="cpp",
    whole=True,
    found=found,
)
