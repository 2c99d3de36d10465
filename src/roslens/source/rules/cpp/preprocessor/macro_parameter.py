"""Rule ``cpp.macro_parameter``: a parameter of a macro that is torn apart."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_OPERATORS = frozenset("*/%")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a macro one of whose parameters stands bare beside an arithmetic operator."""
    parameters, value = node.child_by_field_name("parameters"), view.text(node.child_by_field_name("value"))
    if parameters is None or "#" in value or '"' in value or _OPERATORS.isdisjoint(value):
        return
    for one in parameters.named_children:
        name = view.text(one)
        bare = (
            re.search(
                rf"(?:[*/%]\s*{re.escape(name)}\b(?!\s*[\w*&]))|(?<![\w.>\"]){re.escape(name)}\s*[*/%]\s*[\d(]", value
            )
            if name.isidentifier()
            else None
        )
        if bare:
            macro = view.text(node.child_by_field_name("name"))
            yield view.hit_at(
                "cpp.macro_parameter",
                view.place(node.start_byte)[0],
                f"`{name}` of `{macro}` stands bare in `{bare[0]}`; expected `({name})`",
            )
            return


RULE = FileRule(
    id="cpp.macro_parameter",
    title="Parameter of a macro without parentheses",
    finds="A parameter of a macro that stands beside an operator, without parentheses around it. Put them.",
    why="`HALF(a + b)` is `a + b / 2`.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 16-0-6",
        "misra-cpp-2023 19.3.4",
        "autosar-cpp14 M16-0-6",
        "clang-tidy bugprone-macro-parentheses",
    ),
    bad="#define HALF(x) (x / 2)\n",
    good="#define HALF(x) ((x) / 2)\n",
    syntax="cpp",
    kinds=("preproc_function_def",),
    found=found,
)
