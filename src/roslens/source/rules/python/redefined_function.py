"""Rule ``python.redefined_function``: two functions of one name in one class or file, of which the first is lost."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function that takes the name of one before it in the same block, which nothing used meanwhile."""
    block = node if node.type == "module" else node.child_by_field_name("body")
    seen: dict[str, Node] = {}
    for one in block.named_children if block is not None else ():
        if one.type != "function_definition":
            continue
        name = view.text(one.child_by_field_name("name"))
        first = seen.get(name)
        seen[name] = one
        if first is None or _is_stub(first) or _is_used(name, first, one, view):
            continue
        is_same = _code(first, view) == _code(one, view)
        yield view.hit(
            "python.redefined_function",
            one.child_by_field_name("name") or one,
            f"`{name}` is defined again: the definition in line {first.start_point[0] + 1} is lost"
            + (", which is the same" if is_same else "")
            + "; expected another name for one of them, or the first removed",
            certainty=Certainty.HEURISTIC if is_same else None,
        )


def _is_stub(function: Node) -> bool:
    """Tell whether a function does nothing: it stands for one that follows."""
    body = function.child_by_field_name("body")
    inner = [one for one in body.named_children if one.type != "comment"] if body is not None else []
    return all(one.type in ("pass_statement", "raise_statement") or _is_text(one) for one in inner)


def _is_text(statement: Node) -> bool:
    inner = statement.named_children
    return statement.type == "expression_statement" and len(inner) == 1 and inner[0].type in ("string", "ellipsis")


def _is_used(name: str, first: Node, second: Node, view: FileView) -> bool:
    between = view.code[first.end_byte : second.start_byte]
    return re.search(rb"\b" + re.escape(name.encode()) + rb"\b", between) is not None


def _code(function: Node, view: FileView) -> bytes:
    body = function.child_by_field_name("body")
    return b"" if body is None else b" ".join(view.source[body.start_byte : body.end_byte].split())


RULE = FileRule(
    id="python.redefined_function",
    title="Function that is defined twice (Python)",
    finds="Two functions of one name in one class, or in one file, with nothing between them that uses the first. "
    "Functions with decorators and those that do nothing are left out.",
    why="Python keeps the last one, also as the callback that was meant to be the first: the other is never called.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    clauses=("ruff F811", "pylint E0102"),
    syntax="python",
    kinds=("class_definition", "module"),
    bad="class Arm:\n    def tick(self):\n        self.move()\n\n    def tick(self):\n        self.stop()\n",
    good="class Arm:\n    def tick(self):\n        self.move()\n\n    def halt(self):\n        self.stop()\n",
    found=found,
)
