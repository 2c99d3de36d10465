"""Rule ``cpp.dangerous_address``: the address of a copy that a cast made."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ADDRESS = re.compile(rb"(&)\s*(?:static|dynamic|reinterpret)_cast\b")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each address of a cast to no reference."""
    for _match, node in places(_ADDRESS, view, 1):
        around = node if node.type == "pointer_expression" else above(node, "pointer_expression")
        text = view.text(around)
        if around is not None and "&>" not in text.replace(" ", ""):
            yield view.hit(
                "cpp.dangerous_address",
                around,
                f"`{shortened(text, 60)}` is the address of a copy; expected a cast of the address",
            )


RULE = FileRule(
    id="cpp.dangerous_address",
    title="Address of what a cast gives",
    finds="`&static_cast<T>(x)` may be the address of a temporary. Cast the address instead: `static_cast<T*>(&x)`.",
    why="The pointer is dead at the end of the statement.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/casting",
        "paper2016 dangerous_addresses",
    ),
    bad="void f(A& a) { g(&static_cast<B>(a)); }\n",
    good="void f(A& a) { g(static_cast<B*>(&a)); }\n",
    syntax="cpp",
    whole=True,
    words=("static_cast", "dynamic_cast", "reinterpret_cast"),
    found=found,
)
