"""Rule ``cpp.fallthrough``: a case that runs on into the next one."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.cpp_statement import ends_flow, last_statement, next_statement
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_MEANT = re.compile(rb"fall|FALL|thr(?:ough|u)|intentional|no break|deliberate|continue", re.IGNORECASE)

_CHANGES = re.compile(r"^[\w.>-]+\s*[-+*/|&]=")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a case whose last statement runs on into another case."""
    following, preceding = next_statement(node), node.prev_named_sibling
    if following is None or following.type != "case_statement" or node.has_error:
        return
    last = _last(node)
    # Several in a row are a device: what is left to do is less with each case.
    if any(one is not None and _runs_on(one, view) for one in (following, preceding)):
        return
    if last is None or ends_flow(last, view) or last.type in ("attributed_statement", "switch_statement"):
        return
    if _prepares(node, view):
        return
    between = view.content[last.start_byte : following.start_byte]
    tail = view.lines[view.place(max(last.end_byte - 1, 0))[0] - 1]
    code = view.code[last.start_byte : following.start_byte]
    if _MEANT.search(between[-200:]) or _MEANT.search(tail) or b"#" in code or b"FALLTHROUGH" in code:
        return
    if last.type in ("while_statement", "for_statement", "do_statement") and view.text(
        last.child_by_field_name("condition")
    ) in ("(true)", "(1)", ""):
        return
    value = view.text(node.child_by_field_name("value"))
    label = f"case {value}" if value else "default"
    yield view.hit(
        "cpp.fallthrough",
        node.children[0],
        f"`{shortened(label, 60)}` falls through to the next case; expected `break` or `[[fallthrough]]`",
    )


def _prepares(case: Node, view: FileView) -> bool:
    """Return whether all that a case does is to change a value for the next one, or nothing."""
    value = case.child_by_field_name("value")
    inside = [one for one in case.named_children if one.type != "comment" and one != value]
    if len(inside) != 1 or inside[0].type != "expression_statement":
        return False
    return inside[0].named_child_count == 0 or _CHANGES.search(view.text(inside[0])) is not None


def _runs_on(case: Node, view: FileView) -> bool:
    following = next_statement(case)
    last = _last(case) if case.type == "case_statement" else None
    return (
        last is not None and following is not None and following.type == "case_statement" and not ends_flow(last, view)
    )


def _last(case: Node) -> Node | None:
    value = case.child_by_field_name("value")
    inside = [one for one in case.named_children if one.type != "comment" and one != value]
    found = inside[-1] if inside else None
    if found is not None and found.type == "compound_statement":
        return last_statement(found) or found
    return found


RULE = FileRule(
    id="cpp.fallthrough",
    title="Case that falls through",
    finds="A `case` with statements that neither ends in `break`, `return`, `throw`, `continue` or `goto`, nor "
    "says `[[fallthrough]]` or, in a comment, that it falls through. "
    "One that only changes a value which the next case uses (`low -= step;`) is let be.",
    why="A command of one mode also does what the next mode does.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "hicpp 6.1.3",
        "misra-cpp-2008 6-4-5",
        "misra-cpp-2023 9.4.2",
        "autosar-cpp14 M6-4-5",
        "jsf-av 193",
        "paper2016 harosCaseWithoutBreak",
        "clang-tidy clang-diagnostic-implicit-fallthrough",
    ),
    bad="void f(int a) { switch (a) { case 1: g(); case 2: h(); break; } }\n",
    good="void f(int a) { switch (a) { case 1: g(); break; case 2: h(); break; } }\n",
    syntax="cpp",
    kinds=("case_statement",),
    found=found,
)
