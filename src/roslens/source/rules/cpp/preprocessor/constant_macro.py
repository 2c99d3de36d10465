"""Rule ``cpp.constant_macro``: a constant that is a macro."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_VALUE = re.compile(r"^\(?[-+]?(?:0[xX][0-9a-fA-F]+|[\d.]+(?:[eE][-+]?\d+)?)[uUlLfF]*\)?$|^\"[^\"]*\"$|^'.'$")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each macro that is a number or a text."""
    value = view.text(node.child_by_field_name("value")).partition("//")[0].partition("/*")[0].strip()
    if _VALUE.match(value):
        name = view.text(node.child_by_field_name("name"))
        yield view.hit_at(
            "cpp.constant_macro",
            view.place(node.start_byte)[0],
            f"`{name}` is {shortened(value, 40)}; expected `constexpr`",
        )


RULE = FileRule(
    id="cpp.constant_macro",
    title="Macro as a constant",
    finds="A macro whose value is a number or a text. Write `constexpr`.",
    why="It has no type and no scope: `#define PI 3` changes a header that is included later.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 16-2-2",
        "autosar-cpp14 A16-0-1",
        "jsf-av 30",
        "hicpp 16.1.1",
        "clang-tidy cppcoreguidelines-macro-usage",
    ),
    bad="#define RATE 10\n",
    good="constexpr int kRate = 10;\n",
    syntax="cpp",
    kinds=("preproc_def",),
    in_c=False,
    found=found,
)
