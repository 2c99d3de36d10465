"""Rule ``cpp.unreachable``: a statement that is never reached."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import JUMPS, next_statement
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_LAST = re.compile(rb"\s*(?:\}|case\b|default\b|else\b)")
"""Most jumps are the last in their block: to see that, no node is needed."""
_SETTING = re.compile(r"[A-Z][A-Z0-9_]*\s*(?:\([\w\s,\"]*\)\s*)?;?")
"""A macro that is given nothing or constants alone: it sets a warning of the compiler back, says that here is no way
on, or closes what another macro opened."""
_NOT_WRITTEN_YET = re.compile(r"not(?:[ _-]?been|[ _-]?yet)*[ _-]?implemented|unimplemented", re.IGNORECASE)
_ENTRY = re.compile(rb"\b(?:case\b|default\s*:)")
"""A label of the switch around: what holds one is reached from there."""
_WAY_OUT = re.compile(r"(?:std::|::)?_?(?:exit|abort|quick_exit|terminate)\s*\(")
_MAY_FOLLOW = (
    "break_statement",
    "case_statement",
    "labeled_statement",
    "else_clause",
    "function_definition",
    "ERROR",
    "preproc_if",
    "preproc_ifdef",
    "preproc_else",
    "preproc_elif",
    "preproc_call",
    "preproc_def",
    "preproc_include",
    "preproc_function_def",
    "class_specifier",
    "struct_specifier",
    "access_specifier",
    "type_definition",
    "alias_declaration",
    "template_declaration",
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the statement behind a jump."""
    if _LAST.match(view.code, node.end_byte):
        return
    following = next_statement(node)
    block = node.parent
    if following is None or following.type in _MAY_FOLLOW or block is None or following.text == b";":
        return
    if block.type not in ("compound_statement", "case_statement") or block.has_error:
        return
    if _stands_on_purpose(node, following, view):
        return
    if block.type == "compound_statement" and b"#" in view.code[node.start_byte : following.end_byte]:
        return
    if following.type == "compound_statement" and _ENTRY.search(view.code[following.start_byte : following.end_byte]):
        return
    if _SETTING.fullmatch(view.text(following)):
        return
    if view.code[: node.start_byte].rstrip()[-1:] == b")":
        return  # nothing ends what stands before: a macro that writes an `if`
    jump = node.type.partition("_")[0]
    yield view.hit("cpp.unreachable", following, f"`{view.short(following, 50)}` stands behind `{jump}` and never runs")


def _stands_on_purpose(jump: Node, following: Node, view: FileView) -> bool:
    """Whether a statement behind a jump is asked for by compilers, or waits until what throws is implemented."""
    if following.type == "return_statement":
        # Compilers ask for a value behind what they do not know to throw.
        return jump.type in ("return_statement", "throw_statement")
    return jump.type == "throw_statement" and bool(
        _WAY_OUT.match(view.text(following)) or _NOT_WRITTEN_YET.search(view.text(jump))
    )


RULE = FileRule(
    id="cpp.unreachable",
    title="Unreachable statement",
    finds="A statement behind `return`, `throw`, `break`, `continue` or `goto` in the same block. A `break` "
    "or a second `return` behind a `return` is let be, and so is what waits behind a `throw` that says that it is not "
    "implemented yet. Remove it, or fix the order.",
    why="What is meant to happen last, such as stopping a motor or closing a port, never does.",
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
    ),
    clauses=(
        "misra-cpp-2008 0-1-1",
        "misra-cpp-2023 0.0.1",
        "autosar-cpp14 M0-1-1",
        "jsf-av 186",
        "hicpp 1.2.1",
        "clang-tidy clang-diagnostic-unreachable-code",
    ),
    bad="int f() { return 1; stop(); }\n",
    good="int f() { stop(); return 1; }\n",
    syntax="cpp",
    kinds=JUMPS,
    found=found,
)
