"""Rule ``cpp.unique_pointer_parameter``: an owner that is lent."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_LENT = re.compile(rb"(unique_ptr)\s*<[^;{}()]*>\s*(?:const\s*)?&(?!&)")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such parameter."""
    for _match, node in places(_LENT, view, 1):
        around = above(node, "parameter_declaration", "declaration", "field_declaration")
        if around is not None and around.type == "parameter_declaration" and view.text(around).startswith("const"):
            yield view.hit(
                "cpp.unique_pointer_parameter",
                around,
                f"`{view.short(around)}` lends the owner; expected `T&`, or the pointer by value",
            )


RULE = FileRule(
    id="cpp.unique_pointer_parameter",
    title="Smart pointer by reference to const",
    finds="A parameter `const std::unique_ptr<T>&`. Take `T&` or `T*` where the function only uses it, "
    "`std::unique_ptr<T>` by value where it keeps it.",
    why="A reader cannot see who owns the driver.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "paper2016",
    ),
    clauses=(
        "hicpp 8.2.4",
        "paper2016 harosConstUniquePtr",
    ),
    bad="void f(const std::unique_ptr<A>& a);\n",
    good="void f(A& a);\n",
    syntax="cpp",
    whole=True,
    words=("unique_ptr",),
    found=found,
)
