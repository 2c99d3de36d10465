"""Rule ``cpp.alternative_tokens``: operators that are written as words."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each operator that is a word."""
    word = view.text(node)
    if node.type == word and node.parent is not None and node.parent.type.endswith("expression"):
        yield view.hit("cpp.alternative_tokens", node, f"`{word}`; expected the operator in signs")


RULE = FileRule(
    id="cpp.alternative_tokens",
    title="Operators written as words",
    finds="`and`, `or`, `not` and their like for operators. Write `&&`, `||`, `!`.",
    why="Readers of one code base should not meet two spellings of one operator.",
    severity=Severity.NOTE,
    profiles=(
        "google",
        "hicpp",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/alt_tokens",
        "paper2016 alternative_tokens",
    ),
    bad="bool f(bool a, bool b) { return a and not b; }\n",
    good="bool f(bool a, bool b) { return a && !b; }\n",
    syntax="cpp",
    anchors=("and", "or", "not", "bitand", "bitor", "xor", "compl", "not_eq", "and_eq", "or_eq", "xor_eq"),
    in_c=False,
    found=found,
)
