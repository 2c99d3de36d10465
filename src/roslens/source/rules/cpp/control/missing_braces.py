"""Rule ``cpp.missing_braces``: a body without braces."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each body that is no block."""
    if node.type == "else_clause":
        inside = [one for one in node.named_children if one.type != "comment"]
        body = inside[0] if inside and inside[0].type != "if_statement" else None
    else:
        body = node.child_by_field_name("consequence") or node.child_by_field_name("body")
    if body is not None and body.type not in ("compound_statement", "comment", "ERROR") and not node.has_error:
        what = node.type.partition("_")[0]
        yield view.hit(
            "cpp.missing_braces",
            body,
            f"the body of this `{what}` has no braces; expected `{{ {view.short(body, 40)} }}`",
        )


RULE = FileRule(
    id="cpp.missing_braces",
    title="Body without braces",
    finds="The body of `if`, `else`, `for`, `while` or `do` is no block. Put braces around it.",
    why="A line added later to an emergency branch is not part of it.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "ros-style",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/braces",
        "misra-cpp-2008 6-3-1",
        "misra-cpp-2008 6-4-1",
        "misra-cpp-2023 9.3.1",
        "autosar-cpp14 M6-3-1",
        "autosar-cpp14 M6-4-1",
        "jsf-av 59",
        "hicpp 6.1.1",
        "paper2016 else_braces",
        "paper2016 single_if_else",
        "clang-tidy readability-braces-around-statements",
    ),
    bad="void f(bool a) {\n  if (a) g();\n}\n",
    good="void f(bool a) {\n  if (a) {\n    g();\n  }\n}\n",
    syntax="cpp",
    kinds=("if_statement", "else_clause", "for_statement", "for_range_loop", "while_statement", "do_statement"),
    found=found,
)
