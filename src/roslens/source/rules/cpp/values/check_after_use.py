"""Rule ``cpp.check_after_use``: it is asked whether a pointer is null after it was followed."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ASKED = re.compile(
    rb"if\s*\(\s*(?:!\s*([A-Za-z_]\w*)|([A-Za-z_]\w*)\s*[!=]=\s*(?:nullptr|NULL)|(?:nullptr|NULL)\s*[!=]=\s*([A-Za-z_]\w*))"
    rb"\s*(?:\)|\|\||&&)"
)
_PLAIN = ("expression_statement", "declaration")
_MOST_STATEMENTS = 3


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each condition that asks whether a pointer is null that one of the last statements followed."""
    for node in nodes:
        asked = _ASKED.match(view.code, node.start_byte)
        condition = node.child_by_field_name("condition") if asked is not None else None
        if condition is None or asked is None:
            continue
        name = next(one for one in asked.groups() if one is not None)
        used = _used_before(name, node, view)
        if used is not None:
            text = name.decode("utf-8", "replace")
            yield view.hit(
                "cpp.check_after_use",
                condition,
                f"whether `{text}` is null is asked after line {used} followed it; expected the question before",
            )


def _used_before(name: bytes, statement: Node, view: FileView) -> int | None:
    """Return the line at which one of the last statements of the block follows a pointer, whatever comes."""
    if statement.parent is None or statement.parent.type != "compound_statement":
        return None
    follows = re.compile(rb"(?<![\w.>:&])" + name + rb"\s*->\s*\w+|(?:[=(,!+<>-]|\breturn)\s*\*" + name + rb"\b")
    other = re.compile(rb"(?<![\w.>:])" + name + rb"\b(?!\s*->)")
    before, count = statement.prev_named_sibling, 0
    while before is not None and count < _MOST_STATEMENTS:
        if before.type == "comment":
            before = before.prev_named_sibling
            continue
        code = view.code[before.start_byte : before.end_byte]
        if before.type not in _PLAIN:
            return None
        match = follows.search(code)
        if match is not None and not _is_guarded(before, match.start(), code, name, view):
            return view.place(before.start_byte + match.start())[0]
        if other.search(code):
            return None
        before, count = before.prev_named_sibling, count + 1
    return None


def _is_guarded(statement: Node, at: int, code: bytes, name: bytes, view: FileView) -> bool:
    """Return whether something in a statement decides whether the pointer is followed, or sets it there."""
    place = view.node_at(statement.start_byte + at, statement.start_byte + at + len(name))
    if place is None or above(place, "lambda_expression", *_PLAIN, "sizeof_expression", "decltype") != statement:
        return True
    if re.search(rb"&&|\|\||\?|\bassert|\bsizeof|\bdecltype|\bCHECK", code[:at]):
        return True
    is_set = rb"(?<![\w.>])" + name + rb"\s*(?:=(?!=)|\.\s*reset|\+\+|--)|&\s*" + name + rb"\b|(?:\+\+|--)" + name
    return re.search(is_set, code) is not None


RULE = FileRule(
    id="cpp.check_after_use",
    title="Pointer checked after it was followed",
    finds="A condition that asks whether a pointer is null, where one of the three statements before it in the block "
    "follows the pointer without a condition. Ask first.",
    why="Where the pointer can be null, the program crashes before it asks; where it cannot, the question is noise.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("memory", "conditions"),
    clauses=("cppcheck nullPointerRedundantCheck",),
    bad="void f(Arm * arm) { arm->stop(); if (!arm) { return; } }\n",
    good="void f(Arm * arm) { if (!arm) { return; } arm->stop(); }\n",
    syntax="cpp",
    kinds=("if_statement",),
    found_among=found_among,
)
