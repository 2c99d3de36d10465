"""Rule ``cpp.misleading_indentation``: a statement that looks as if it belonged to a branch."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import next_statement
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield what follows a body without braces at the indentation of the body."""
    body = _body(node)
    whole = _statement(node) if body is not None else None
    if body is None or whole is None:
        return
    following = next_statement(whole)
    if (
        following is None
        or following.type in ("else_clause", "case_statement", "labeled_statement")
        or following.type.startswith("preproc")
    ):
        return
    opening = view.code[node.start_byte : body.start_byte]
    if b"\n" not in opening or b"#" in view.code[body.start_byte : following.start_byte] or following.text == b";":
        return
    if b"\n\n" in view.content[body.end_byte : following.start_byte].replace(b"\r", b""):
        return  # a paragraph of its own
    lead = _lead(node, view)
    inner, after = _lead(body, view), _lead(following, view)
    if inner is None or lead is None or inner != after or len(inner) <= len(lead):
        return
    block = following.parent.named_children if following.parent is not None else []
    if block and block[0].start_byte != whole.start_byte and _lead(block[0], view) == after:
        return  # it stands where the block does; the branch before it is too far left
    text = view.short(following, 40)
    yield view.hit(
        "cpp.misleading_indentation",
        following,
        f"`{text}` is indented like the body of this branch, but is not in it; expected braces",
    )


def _body(node: Node) -> Node | None:
    """Return the body of a branch or loop; None of one with braces, or of another branch."""
    if node.type == "else_clause":
        body = node.named_children[-1] if node.named_child_count else None
    else:
        body = node.child_by_field_name("consequence") or node.child_by_field_name("body")
    if body is None or body.type in ("compound_statement", "if_statement", "comment", "ERROR"):
        return None
    return body


def _statement(node: Node) -> Node | None:
    """Return the whole statement that a branch or loop ends; None of a branch that another one follows."""
    whole = node.parent if node.type == "else_clause" else node
    if whole is None or (whole == node and node.child_by_field_name("alternative") is not None):
        return None
    while whole.parent is not None and whole.parent.type in ("else_clause", "if_statement"):
        whole = whole.parent
    return whole


def _lead(node: Node, view: FileView) -> bytes | None:
    """Return the white space before a node, None where it is not the first of its line."""
    line, column = view.place(node.start_byte)
    before = view.lines[line - 1][: column - 1]
    if node.type == "else_clause":
        before = before.rstrip(b"} \t") if before.strip() == b"}" else before
        return view.lines[line - 1][: len(view.lines[line - 1]) - len(view.lines[line - 1].lstrip())]
    return before if not before.strip() else None


RULE = FileRule(
    id="cpp.misleading_indentation",
    title="Statement indented as if it were guarded",
    finds="The statement behind an `if`, `else`, `for` or `while` without braces is indented like its body, but "
    "always runs. Add braces, or take the indentation back.",
    why="What looks as if it ran in an emergency only runs always, as in the well-known `goto fail`.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    clauses=("clang-tidy readability-misleading-indentation",),
    bad="void f(bool hot) {\n  if (hot)\n    log();\n    stop();\n}\n",
    good="void f(bool hot) {\n  if (hot)\n    log();\n  stop();\n}\n",
    syntax="cpp",
    kinds=("if_statement", "for_statement", "while_statement", "for_range_loop", "else_clause"),
    found=found,
)
