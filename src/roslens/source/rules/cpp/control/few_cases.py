"""Rule ``cpp.few_cases``: a choice among one."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each switch with one label or none."""
    body = node.child_by_field_name("body")
    if body is None or b"#" in view.code[node.start_byte : node.end_byte]:
        return
    cases = [one for one in body.named_children if one.type == "case_statement" and one.child_by_field_name("value")]
    if len(cases) < 2:
        yield view.hit_at(
            "cpp.few_cases", view.place(node.start_byte)[0], f"`switch` with {len(cases)} case; expected an `if`"
        )


RULE = FileRule(
    id="cpp.few_cases",
    title="`switch` with one case",
    finds="A `switch` with fewer than two cases beside `default`. Write an `if`.",
    why="Two ways of saying one thing hide which one was meant to grow.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "hicpp 6.1.4",
        "misra-cpp-2008 6-4-8",
        "autosar-cpp14 A6-4-1",
        "jsf-av 196",
    ),
    bad="void f(int a) { switch (a) { case 1: g(); break; default: h(); } }\n",
    good="void f(int a) { if (a == 1) g(); else h(); }\n",
    syntax="cpp",
    kinds=("switch_statement",),
    found=found,
)
