"""Rule ``cpp.alternative_tokens``: operators that are written as words."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.spans import with_space

_SIGNS = {
    "and": "&&", "or": "||", "not": "!", "bitand": "&", "bitor": "|", "xor": "^", "compl": "~", "not_eq": "!=",
    "and_eq": "&=", "or_eq": "|=", "xor_eq": "^=",
}  # fmt: skip


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each operator that is a word."""
    word = view.text(node)
    if node.type == word and node.parent is not None and node.parent.type.endswith("expression"):
        yield view.hit(
            "cpp.alternative_tokens", node, f"`{word}`; expected the operator in signs", edits=_edits(node, word, view)
        )


def _edits(node: Node, word: str, view: FileView) -> tuple[Edit, ...]:
    sign = _SIGNS[word]
    if word in ("not", "compl"):
        start, end = with_space(view.content, node.start_byte, node.end_byte)
        return view.edits((start, end, sign)) if start == node.start_byte else ()
    return view.edits((node.start_byte, node.end_byte, sign))


RULE = FileRule(
    id="cpp.alternative_tokens",
    title="Operators written as words",
    finds="`and`, `or`, `not` and their like for operators. Write `&&`, `||`, `!`.",
    why="Readers of one code base should not meet two spellings of one operator.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "hicpp",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/alt_tokens",
        "paper2016 alternative_tokens",
    ),
    fix="Writes the sign.",
    bad="bool f(bool a, bool b) { return a and not b; }\n",
    good="bool f(bool a, bool b) { return a && !b; }\n",
    syntax="cpp",
    anchors=tuple(_SIGNS),
    in_c=False,
    found=found,
)
