"""Rule ``cpp.side_effect_in_logic``: an effect that only sometimes happens."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_EFFECT = re.compile(r"\+\+|--|(?<![=!<>])=(?!=)")


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each ``&&`` or ``||`` whose right operand changes something."""
    code = view.code
    words = [word for word in (b"and", b"or") if word in view.words]
    for node in nodes:
        start, end = node.byte_range
        if (
            code.find(b"&&", start, end) >= 0
            or code.find(b"||", start, end) >= 0
            or (words and any(code.find(word, start, end) >= 0 for word in words))
        ):
            yield from _found(node, view)


def _found(node: Node, view: FileView) -> Iterator[Hit]:
    right = node.child_by_field_name("right")
    code = view.code[right.start_byte : right.end_byte] if right is not None else b""
    if right is None or not (b"=" in code or b"++" in code or b"--" in code):
        return
    if view.text(node.child_by_field_name("operator")) not in ("&&", "||", "and", "or"):
        return
    text = view.text(right)
    if (
        _EFFECT.search(text)
        and next(below(right, "update_expression", "assignment_expression", inside=("lambda_expression",)), None)
    ) or right.type in ("update_expression", "assignment_expression"):
        yield view.hit(
            "cpp.side_effect_in_logic",
            right,
            f"`{shortened(text, 60)}` changes something only where the left side lets it; expected a statement of its "
            "own",
        )


RULE = FileRule(
    id="cpp.side_effect_in_logic",
    title="Effect on the right of `&&` or `||`",
    finds="An assignment, `++` or `--` in the right operand of `&&` or `||`: whether it happens depends on the "
    "left one. Do it before, or behind.",
    why="A counter of failures misses exactly the cases in which the left side decided.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 5-14-1",
        "misra-cpp-2023 8.14.1",
        "autosar-cpp14 M5-14-1",
        "jsf-av 157",
        "hicpp 5.1.6",
    ),
    bad="bool f(bool a, int n) { return a && ++n > 3; }\n",
    good="bool f(bool a, int n) { ++n; return a && n > 3; }\n",
    syntax="cpp",
    kinds=("binary_expression",),
    found_among=found_among,
)
