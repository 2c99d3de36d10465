"""Rule ``cpp.empty_body``: an `if` or loop that a stray semicolon ends."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a body that is one semicolon, of a loop only where a block follows."""
    body = node.child_by_field_name("consequence") or node.child_by_field_name("body")
    if body is None or body.type != "expression_statement" or body.named_child_count or body.text != b";":
        return
    following = node.next_named_sibling
    while following is not None and following.type == "comment":
        following = following.next_named_sibling
    if node.type != "if_statement" and (following is None or following.type != "compound_statement"):
        return
    if _is_cut_out(body, view):
        return
    what = node.type.partition("_")[0]
    yield view.hit("cpp.empty_body", body, f"`;` is the whole body of this `{what}`; expected a statement, or `{{}}`")


def _is_cut_out(body: Node, view: FileView) -> bool:
    """Return whether what stands before the semicolon is no closing parenthesis: a macro was cut out of the source."""
    return not view.code[: body.start_byte].rstrip().endswith(b")")


RULE = FileRule(
    id="cpp.empty_body",
    title="Body that is a lone semicolon",
    finds="`if (…);`, or `for (…);` or `while (…);` with a block behind it: the semicolon is the body. Remove "
    "it; write `{}` where nothing is meant.",
    why="The block behind it always runs, whatever the condition says: an emergency stop, or the motion that "
    "it guards.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint whitespace/empty_if_body",
        "cpplint whitespace/empty_conditional_body",
        "misra-cpp-2008 6-2-3",
        "paper2016 empty_statement",
        "clang-tidy bugprone-suspicious-semicolon",
    ),
    bad="void f(bool hot) { if (hot); { stop(); } }\n",
    good="void f(bool hot) { if (hot) { stop(); } }\n",
    syntax="cpp",
    kinds=(
        "(if_statement consequence: (expression_statement)) @node",
        "(for_statement body: (expression_statement)) @node",
        "(while_statement body: (expression_statement)) @node",
    ),
    found=found,
)
