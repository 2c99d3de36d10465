"""Rule ``python.is_literal``: identity with a literal."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_LITERALS = frozenset({"string", "integer", "float", "list", "dictionary", "tuple", "set", "concatenated_string"})


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``is`` and ``is not`` beside a literal."""
    operators = {child.type for child in node.children}
    if not operators & {"is", "is not"}:
        return
    children = node.children
    for at, sign in enumerate(children):
        if sign.type not in ("is", "is not") or not 0 < at < len(children) - 1:
            continue
        if _LITERALS & {children[at - 1].type, children[at + 1].type}:
            expected = "==" if sign.type == "is" else "!="
            message = f"{view.short(node)!r} asks for the same object; expected {expected!r}"
            edits = view.edits((sign.start_byte, sign.end_byte, expected))
            yield view.hit("python.is_literal", node, message, edits=edits)
            return


RULE = FileRule(
    id="python.is_literal",
    title="Identity with a literal",
    finds="`is` or `is not` beside a number, a text, a list, a tuple or a dictionary. Write `==` or `!=`.",
    why="Whether equal values are one object is chance: the branch is taken on one machine, or for small numbers, "
    "and not on another.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("comparison_operator",),
    clauses=("ruff F632", "pylint R0123"),
    fix="Writes `==` or `!=`.",
    bad='if mode is "auto":\n    start()',
    good='if mode == "auto":\n    start()',
    found=found,
)
