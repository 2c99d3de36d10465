"""Rule ``cpp.single_exit``: a function that is left in several places."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import function_of
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each function with more than one return of its own."""
    code = view.code
    for node in nodes:
        if code.count(b"return", node.start_byte, node.end_byte) > 1:
            yield from _found(node, view)


def _found(node: Node, view: FileView) -> Iterator[Hit]:
    body = node.child_by_field_name("body")
    if body is None or view.code.count(b"return", body.start_byte, body.end_byte) < 2:
        return
    code = view.code[body.start_byte : body.end_byte]
    if b"](" not in code and b"] (" not in code and b"] {" not in code and b"class" not in code:
        count = sum(1 for _ in word_places(b"return", view, body.start_byte, body.end_byte))
        first = view.node_at(
            *(2 * (next(word_places(b"return", view, body.start_byte, body.end_byte), body.start_byte),))
        )
    else:
        returns = list(
            below(body, "return_statement", inside=("lambda_expression", "class_specifier", "struct_specifier"))
        )
        count, first = len(returns), returns[0] if returns else None
    if count > 1 and first is not None:
        name = function_of(node, view).name
        yield view.hit_at(
            "cpp.single_exit", view.place(first.start_byte)[0], f"{count} returns in `{name}`; expected one at the end"
        )


RULE = FileRule(
    id="cpp.single_exit",
    title="More than one `return`",
    finds="A function with more than one `return`. Leave it at its end.",
    why="Standards ask for it, so that what was taken is given back in one place. With destructors that do so "
    "it costs more than it gives, and is on by name only.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "misra-cpp-2008",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 6-6-5",
        "jsf-av 113",
    ),
    bad="int f(int a) { if (a) return 1; return 2; }\n",
    good="int f(int a) { int r = 2; if (a) r = 1; return r; }\n",
    syntax="cpp",
    kinds=("function_definition",),
    found_among=found_among,
)
