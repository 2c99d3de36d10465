"""Rule ``python.equals_none``: a comparison with None by value."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``== None`` and ``!= None``."""
    children = node.children
    for left, sign, right in zip(children, children[1:], children[2:], strict=False):
        if sign.type in ("==", "!=") and "none" in (left.type, right.type):
            expected = "is None" if sign.type == "==" else "is not None"
            yield view.hit(
                "python.equals_none",
                node,
                f"{view.short(node)!r} compares by value; expected {expected!r}",
            )
            return


RULE = FileRule(
    id="python.equals_none",
    title="Comparison with nothing by value",
    finds="`== None` and `!= None`. Write `is None`, `is not None`.",
    why="An array of NumPy answers for each of its elements: `if image == None` raises as soon as there is an image.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("comparison_operator",),
    clauses=("pycodestyle E711", "ruff E711"),
    bad="if image == None:\n    image = black()",
    good="if image is None:\n    image = black()",
    found=found,
)
